// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/bounded_part.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/triangle_p.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace fcl_prob::detail {
namespace {

/// normal·x = offset in the world, |normal| = 1.
struct PlacedPlane {
  Eigen::Vector3d normal;
  double offset;
};

/// The rotation of the pose need not keep the length of the normal to the last bit.
template <typename Shape>
PlacedPlane planeOf(const Shape& shape, const fcl::Transform3d& pose) {
  const Eigen::Vector3d along = pose.linear() * shape.n;
  const double length = along.norm();
  const Eigen::Vector3d normal = along / length;
  return {normal, shape.d / length + normal.dot(pose.translation())};
}

/// The pose whose z axis is `normal` and whose origin is the foot of `centre` on the plane
/// normal·x = offset.
fcl::Transform3d poseOnPlane(const Eigen::Vector3d& normal, double offset,
                             const Eigen::Vector3d& centre) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.linear() =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal).toRotationMatrix();
  pose.translation() = centre + (offset - normal.dot(centre)) * normal;
  return pose;
}

/// The partition's bound on the rounding of a shape grows with its size: made this large, it covers
/// the rounding of the plane's offset too.
double sizeFor(double reach, double plane_offset, const fcl::Transform3d& pose,
               const Eigen::Vector3d& centre) {
  return reach + std::fabs(plane_offset) + pose.translation().norm() + centre.norm();
}

Eigen::Vector3d middle(const PartitionObject& object, std::size_t part) {
  return object.parts[part].pose * object.tree->parts[part].origin;
}

}  // namespace

ReachedBall reachedBall(const PartitionObject& object, const GaussianDisplacement& displacement,
                        double deviations) {
  const Eigen::Vector3d centre = middle(object, 0);
  double extent = 0.0;
  for (std::size_t i = 0; i < object.parts.size(); ++i) {
    extent = std::max(extent, (middle(object, i) - centre).norm() + object.tree->parts[i].radius);
  }
  const double moved =
      displacement.mean().norm() + deviations * displacement.standardDeviations().norm();
  return {centre, 1.01 * (moved + extent)};  // a margin for the rounding of these
}

BoundedPart boundedPart(const fcl::CollisionGeometryd& unbounded, const fcl::Transform3d& pose,
                        const ReachedBall& ball) {
  const Eigen::Vector3d& centre = ball.centre;
  const double reach = ball.radius;
  if (unbounded.getNodeType() == fcl::GEOM_PLANE) {
    const auto& plane = static_cast<const fcl::Planed&>(unbounded);
    const auto [normal, offset] = planeOf(plane, pose);
    const double far =
        2 * sizeFor(reach, plane.d, pose, centre);  // the inscribed circle has half the radius
    return {std::make_shared<fcl::TrianglePd>(
                Eigen::Vector3d(far, 0, 0), Eigen::Vector3d(-0.5 * far, std::sqrt(0.75) * far, 0),
                Eigen::Vector3d(-0.5 * far, -std::sqrt(0.75) * far, 0)),
            poseOnPlane(normal, offset, centre)};
  }
  const auto& halfspace = static_cast<const fcl::Halfspaced&>(unbounded);
  const auto [normal, offset] = planeOf(halfspace, pose);
  const double half = sizeFor(reach, halfspace.d, pose, centre);
  const double depth = std::max(0.0, offset - normal.dot(centre)) + half;
  BoundedPart part{std::make_shared<fcl::Boxd>(2 * half, 2 * half, depth),
                   poseOnPlane(normal, offset, centre)};
  part.pose.translation() -= 0.5 * depth * normal;
  return part;
}

}  // namespace fcl_prob::detail
