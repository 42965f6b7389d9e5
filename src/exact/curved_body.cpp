// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/curved_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace fcl_prob::detail {
namespace {

/// By more than this share a matrix that counts as a rotation does not shorten anything.
constexpr double kNearlyRotation = 1.0 - 1e-8;

/// Spheres, capsules and what is a point.
std::optional<CurvedBody> roundedBody(const RoundedZonotope& shape, const LongMatrix3& rotation) {
  if (shape.core.generatorCount() > 1 || !(shape.radius > 0.0)) return std::nullopt;
  CurvedBody body;
  body.centre = shape.core.centre();
  body.ellipsoid = rotation * static_cast<long double>(shape.radius);
  body.least_axis = shape.radius * kNearlyRotation;
  if (shape.core.generatorCount() == 0) return body;
  const Eigen::Vector3d along = shape.core.generator(0);
  const Eigen::Vector3d axis = along.stableNormalized();
  const Eigen::Vector3d across = axis.unitOrthogonal();
  body.frustum = Frustum{along.stableNorm(), 0.0, 0.0};
  LongMatrix3 frame;
  frame << across.cast<long double>(), axis.cross(across).cast<long double>(),
      axis.cast<long double>();
  body.frame = rotation * frame;
  return body;
}

/// Ellipsoids, cylinders and cones: the third semi-axis of the latter is 0, their axis is z.
std::optional<CurvedBody> sweptBody(const SupportShape& shape, const LongMatrix3& rotation) {
  CurvedBody body;
  if (shape.semi_axes(2, 2) > 0.0) {
    if (shape.points.size() > 1) return std::nullopt;
    body.centre = shape.points[0];
    body.ellipsoid = rotation * shape.semi_axes.cast<long double>();
    body.least_axis = shape.semi_axes.diagonal().minCoeff() * kNearlyRotation;
    return body;
  }
  if (shape.points.size() != 2) return std::nullopt;
  const double radius = shape.semi_axes(0, 0);
  const Eigen::Vector3d &first = shape.points[0], &second = shape.points[1];
  Frustum frustum{0.5 * std::abs(second.z() - first.z()), radius, shape.swept == 2 ? radius : 0.0};
  if (first.z() > second.z()) std::swap(frustum.bottom, frustum.top);
  body.frustum = frustum;
  body.frame = rotation;
  body.centre = 0.5 * (first + second);
  return body;
}

}  // namespace

double Frustum::inradius() const {
  const double slant = std::hypot(2.0 * half_height, bottom - top);
  if (!(slant > 0.0)) return 0.0;
  const double to_side = 0.5 * (bottom + top) * (2.0 * half_height / slant);
  return std::min(half_height, to_side) * kNearlyRotation;
}

std::optional<CurvedBody> curvedBody(const ConvexBody& body, const Eigen::Matrix3d& rotation) {
  const LongMatrix3 turned = rotation.cast<long double>();
  if (body.set().rounded()) return roundedBody(*body.set().rounded(), turned);
  const SupportShape* shape = body.set().curvedShape();
  if (!shape) return std::nullopt;
  return sweptBody(*shape, turned);
}

SupportShape shapeOf(const ConvexBody& body) {
  if (const auto& rounded = body.set().rounded()) return supportShape(*rounded);
  if (const SupportShape* shape = body.set().curvedShape()) return *shape;
  return {body.set().outerMesh().vertices, 0, Eigen::Matrix3d::Zero()};
}

}  // namespace fcl_prob::detail
