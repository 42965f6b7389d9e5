// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/ellipsoid_polytope.h"

#include <Eigen/LU>
#include <algorithm>

#include "base/constants.h"
#include "geometry/exact_sum.h"
#include "mass/long_whitening.h"

namespace fcl_prob::detail {
namespace {

/// Of a corner mapped in long doubles and rounded once.
constexpr double kCornerRounding = 4.0 * kEpsilon;

/// Of positions, known to 2⁻⁶².
constexpr double kPlaceRounding = 0x1p-57;

/// Nothing for what is no ellipsoid. (Spheres are rounded zonotopes.)
const SupportShape* ellipsoidOf(const ConvexBody& body) {
  if (body.set().rounded()) return nullptr;
  const SupportShape* shape = body.set().curvedShape();
  return shape && shape->points.size() == 1 && shape->semi_axes(2, 2) > 0.0 ? shape : nullptr;
}

/// The image of a polytope, about its own origin.
FaceSet mappedFaces(const ConvexMesh& mesh, const LongMatrix3& map) {
  FaceSet faces;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    faces.addVertex((map * v.cast<long double>()).cast<double>());
  }
  for (const ConvexMesh::Face& face : mesh.faces) {
    faces.beginFace();
    for (int k = 0; k < face.count; ++k) {
      faces.addCorner(mesh.corners[static_cast<std::size_t>(face.first + k)]);
    }
  }
  return faces;
}

}  // namespace

bool isEllipsoidWithPolytope(const ConvexBody& a, const ConvexBody& b) {
  return (ellipsoidOf(a) && b.isPolytope()) || (a.isPolytope() && ellipsoidOf(b));
}

PairMass ellipsoidPolytopeMass(const ConvexBody& a, const fcl::Transform3d& pose_a,
                               const ConvexBody& b, const fcl::Transform3d& pose_b,
                               const GaussianDisplacement& displacement,
                               const RoundedEffort& effort) {
  const PairFrame frame = pairFrame(a, pose_a, b, pose_b, displacement);
  if (!frame.fits || frame.rank < 3) return {};
  const bool first = ellipsoidOf(a) != nullptr;
  const SupportShape& ellipsoid = first ? *ellipsoidOf(a) : *ellipsoidOf(b);
  const LongVector3 semi_axes = ellipsoid.semi_axes.diagonal().cast<long double>();
  const LongMatrix3 rotation = (first ? frame.rotation_a : frame.rotation_b).cast<long double>();
  const LongMatrix3 to_ball = semi_axes.cwiseInverse().asDiagonal() * rotation.inverse();
  const ConvexMesh& flat = (first ? b : a).set().outerMesh();
  ConvexMesh mesh = flat;
  if (!first) reflect(flat, Eigen::Matrix3d::Identity(), mesh);
  const LongMatrix3 turn = (first ? frame.rotation_b : frame.rotation_a).cast<long double>();
  ExactPosition offset;
  offset.add(pose_b.translation());
  offset.add(pose_a.translation(), -1.0);
  offset.add(displacement.mean(), -1.0);
  RoundedPolytope body;
  const FaceSet faces = mappedFaces(mesh, to_ball * turn);
  body.core = toClosedPolytope(faces);
  body.origin = to_ball * offset.value();
  body.radius = 1.0;
  double size = 1.0;
  for (const Eigen::Vector3d& v : faces.vertices()) size = std::max(size, v.norm());
  body.error = kCornerRounding * size +
               mesh.slack * static_cast<double>(to_ball.norm()) * (1.0 + kEpsilon) +
               kPlaceRounding * static_cast<double>(body.origin.norm());
  const LongMatrix3 from_ball = rotation * LongMatrix3(semi_axes.asDiagonal());
  const LongMatrix3 whitening = longWhitening(displacement);
  const RoundedMass mass = roundedPolytopeMass(body, whitening * from_ball, effort);
  PairMass result{mass.mass, std::nullopt};
  if (mass.moment) result.gradient = gradientOf(*mass.moment, whitening.cast<double>());
  return result;
}

}  // namespace fcl_prob::detail
