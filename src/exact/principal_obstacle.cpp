// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/principal_obstacle.h"

#include <algorithm>

#include "base/constants.h"
#include "exact/curved_body.h"
#include "geometry/exact_sum.h"
#include "mass/long_whitening.h"

namespace fcl_prob::detail {
namespace {

/// Of support points and values, next to the sizes of both shapes: points and semi-axes are rounded
/// once (0.5 ε, and as much for each entry); a point on the ball is of length 1 to 3 ε, its image a
/// sum of three products (1.5 ε), a height another one and, for the choice of the highest, twice
/// that; two sums. All in all 21 ε.
constexpr double kSupportRounding = 32.0;

/// A matrix that counts as a rotation does not shorten anything by more.
constexpr double kLeastStretch = 1.0 - 1e-8;

/// Of where the obstacle is, in long doubles.
constexpr double kOffsetRounding = 0x1p-58;

SupportShape mapped(const SupportShape& shape, const LongMatrix3& map) {
  SupportShape image{{}, shape.swept, (map * shape.semi_axes.cast<long double>()).cast<double>()};
  image.points.reserve(shape.points.size());
  for (const Eigen::Vector3d& point : shape.points) {
    image.points.push_back((map * point.cast<long double>()).cast<double>());
  }
  return image;
}

/// How far a body may reach out of the hull that its support function is that of.
double slackOf(const ConvexBody& body) { return body.isPolytope() ? body.set().slack() : 0.0; }

/// In the frame of the geometry.
BallWithin ballInside(const ConvexBody& body, const SupportShape& shape) {
  if (const auto& rounded = body.set().rounded()) return {rounded->core.centre(), rounded->radius};
  const auto curved = curvedBody(body, Eigen::Matrix3d::Identity());
  if (!curved) return {shape.centre(), 0.0};
  BallWithin ball{curved->centre, curved->least_axis};
  if (curved->frustum) ball.radius += curved->frustum->inradius();
  return ball;
}

}  // namespace

PrincipalObstacle::PrincipalObstacle(const PairFrame& frame, const ConvexBody& a,
                                     const fcl::Transform3d& pose_a, const ConvexBody& b,
                                     const fcl::Transform3d& pose_b,
                                     const GaussianDisplacement& displacement) {
  const SupportShape shape_a = shapeOf(a), shape_b = shapeOf(b);
  const double unit = powerOfTwoAt(shape_a.radius() + shape_b.radius());
  const LongMatrix3 axes = longInverseAxes(displacement) / static_cast<long double>(unit);
  const LongMatrix3 map_a = axes * frame.rotation_a.cast<long double>();
  const LongMatrix3 map_b = axes * frame.rotation_b.cast<long double>();
  a_ = mapped(shape_a, map_a);
  b_ = mapped(shape_b, map_b);
  ExactPosition offset;
  offset.add(pose_b.translation());
  offset.add(pose_a.translation(), -1.0);
  offset.add(displacement.mean(), -1.0);
  offset_ = axes * offset.value();
  deviations_ = displacement.standardDeviations().cast<long double>() / unit;
  resolution_ = kEpsilon * (a_.radius() + b_.radius());
  error_ = kSupportRounding * resolution_ + (slackOf(a) + slackOf(b)) / unit +
           kOffsetRounding * static_cast<double>(offset_.norm());
  const BallWithin ball_a = ballInside(a, shape_a), ball_b = ballInside(b, shape_b);
  ball_.centre =
      (map_b * ball_b.centre.cast<long double>() - map_a * ball_a.centre.cast<long double>())
          .cast<double>();
  ball_.radius = (ball_a.radius + ball_b.radius) / unit * kLeastStretch - error_;
  ball_.radius = std::max(ball_.radius, 0.0);
}

}  // namespace fcl_prob::detail
