// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/support_shape.h"

#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "fcl_prob/exceptions.h"
#include "geometry/convex_vertices.h"
#include "geometry/geometry_kind.h"

namespace fcl_prob::detail {
namespace {

// Relative to the size of a shape: points that are as high as the highest.
constexpr double kSameHeight = 1e-9;

struct Farthest {
  int index;
  double height;  // of the point itself, plus the ellipsoid's if it is swept
};

Farthest farthest(const SupportShape& shape, const Eigen::Vector3d& direction, double swept) {
  const auto heightOf = [&](int i) {
    return direction.dot(shape.points[i]) + (i < shape.swept ? swept : 0.0);
  };
  // The first one also where the direction has overflowed and no height is above another.
  Farthest best{0, heightOf(0)};
  for (int i = 1; i < static_cast<int>(shape.points.size()); ++i) {
    const double height = heightOf(i);
    if (height > best.height) best = {i, height};
  }
  return best;
}

SupportShape swept(std::vector<Eigen::Vector3d> points, int count,
                   const Eigen::Vector3d& semi_axes) {
  return {std::move(points), count, semi_axes.asDiagonal()};
}

}  // namespace

Eigen::Vector3d SupportShape::supportPoint(const Eigen::Vector3d& direction) const {
  if (!curved()) return points[farthest(*this, direction, 0.0).index];
  const Eigen::Vector3d on_ball = semi_axes.transpose() * direction;
  const double length = on_ball.norm();
  const int index = farthest(*this, direction, length).index;
  if (index >= swept || !(length > 0.0)) return points[index];
  return points[index] + semi_axes * (on_ball / length);
}

TouchingFace SupportShape::touchingFace(const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d on_ball = semi_axes.transpose() * direction;
  const double length = on_ball.norm();
  const double size = semi_axes.norm();
  const double swept_height = curved() ? length : 0.0;
  const double highest = farthest(*this, direction, swept_height).height;
  const double tolerance = kSameHeight * direction.norm() * (radius() + size);
  // Across a disk's own plane all of the disk lies farthest.
  const bool whole_disk = curved() && length <= kSameHeight * direction.norm() * size;
  const Eigen::Vector3d reach = !curved() || whole_disk
                                    ? Eigen::Vector3d::Zero()
                                    : Eigen::Vector3d(semi_axes * on_ball / length);
  Eigen::Matrix<double, 3, Eigen::Dynamic> farthest_points(3, points.size() + 6);
  Eigen::Index count = 0;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    const bool is_swept = i < swept;
    if (direction.dot(points[i]) + (is_swept ? swept_height : 0.0) < highest - tolerance) continue;
    farthest_points.col(count++) = is_swept ? Eigen::Vector3d(points[i] + reach) : points[i];
    if (!is_swept || !whole_disk || count > 1) continue;
    for (int k = 0; k < 3; ++k) {
      farthest_points.col(count++) = points[i] + semi_axes.col(k);
      farthest_points.col(count++) = points[i] - semi_axes.col(k);
    }
  }
  return TouchingFace::around(farthest_points.leftCols(count));
}

// Of E E'd / |E'd|.
Eigen::Matrix3d SupportShape::supportDerivative(const Eigen::Vector3d& direction) const {
  if (!curved()) return Eigen::Matrix3d::Zero();
  const Eigen::Vector3d on_ball = semi_axes.transpose() * direction;
  const double length = on_ball.norm();
  const int index = farthest(*this, direction, length).index;
  if (index >= swept || !(length > 0.0)) return Eigen::Matrix3d::Zero();
  const Eigen::Vector3d radius = semi_axes * (on_ball / length);
  return (semi_axes * semi_axes.transpose() - radius * radius.transpose()) / length;
}

double SupportShape::supportValue(const Eigen::Vector3d& direction) const {
  const double length = curved() ? (semi_axes.transpose() * direction).norm() : 0.0;
  return farthest(*this, direction, length).height;
}

Eigen::Matrix3d SupportShape::spread() const {
  const Eigen::Vector3d middle = centre();
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    sum += (point - middle) * (point - middle).transpose();
  }
  return sum / static_cast<double>(points.size()) + semi_axes * semi_axes.transpose();
}

std::vector<Eigen::Vector3d> SupportShape::sideNormals() const {
  if (!curved() || !semi_axes.col(2).isZero(0.0)) return {};
  return {semi_axes.col(0).cross(semi_axes.col(1)).stableNormalized()};
}

Eigen::Vector3d SupportShape::centre() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

double SupportShape::radius() const {
  double longest = 0.0;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    longest = std::max(longest, points[i].norm() + (i < swept ? semi_axes.norm() : 0.0));
  }
  return longest;
}

SupportShape SupportShape::transformed(const Eigen::Matrix3d& linear) const {
  SupportShape image{{}, swept, linear * semi_axes};
  image.points.reserve(points.size());
  for (const Eigen::Vector3d& point : points) image.points.push_back(linear * point);
  return image;
}

// FCL centres its round shapes at their origins, with the axis along z; a cone's apex is at +z.
SupportShape supportShape(const fcl::CollisionGeometryd& geometry) {
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  const auto up = [](double length) -> Eigen::Vector3d {
    return 0.5 * length * Eigen::Vector3d::UnitZ();
  };
  switch (geometry.getNodeType()) {
    case fcl::GEOM_SPHERE: {
      const double radius = static_cast<const fcl::Sphered&>(geometry).radius;
      return swept({origin}, 1, Eigen::Vector3d::Constant(radius));
    }
    case fcl::GEOM_ELLIPSOID:
      return swept({origin}, 1, static_cast<const fcl::Ellipsoidd&>(geometry).radii);
    case fcl::GEOM_CAPSULE: {
      const auto& capsule = static_cast<const fcl::Capsuled&>(geometry);
      return swept({-up(capsule.lz), up(capsule.lz)}, 2, Eigen::Vector3d::Constant(capsule.radius));
    }
    case fcl::GEOM_CYLINDER: {
      const auto& cylinder = static_cast<const fcl::Cylinderd&>(geometry);
      return swept({-up(cylinder.lz), up(cylinder.lz)}, 2, {cylinder.radius, cylinder.radius, 0.0});
    }
    case fcl::GEOM_CONE: {
      const auto& cone = static_cast<const fcl::Coned&>(geometry);
      return swept({-up(cone.lz), up(cone.lz)}, 1, {cone.radius, cone.radius, 0.0});
    }
    default:
      if (auto vertices = polytopeVertices(geometry)) return {std::move(*vertices), 0};
      throw UnsupportedGeometry("not a bounded convex shape: " +
                                nodeTypeName(geometry.getNodeType()));
  }
}

}  // namespace fcl_prob::detail
