// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/body_balls.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob::detail {
namespace {

// More than what placing a ball, a distance or a deviation is rounded by.
constexpr double kRounding = 1e-12;

double gaussianUpper(const Ball& body, const Ball& obstacle,
                     const GaussianDisplacement& displacement) {
  const Eigen::Vector3d apart = body.centre - obstacle.centre - displacement.mean();
  const double distance = apart.norm();
  const double size = body.centre.norm() + obstacle.centre.norm() + displacement.mean().norm();
  const double gap = distance - (body.radius + obstacle.radius) - kRounding * size;
  if (!(gap > 0.0)) return 1.0;
  const Eigen::Vector3d along = displacement.axes().transpose() * (apart / distance);
  const double deviation =
      (1.0 + kRounding) * along.cwiseProduct(displacement.standardDeviations()).norm() +
      kRounding * displacement.standardDeviations().maxCoeff();
  if (!(deviation > 0.0)) return 0.0;
  // A tail beyond 38 deviations is no double, but not nothing.
  return std::min(1.0,
                  (1.0 + 1e-9) * normalTailMass((1.0 - kRounding) * gap / deviation) + kUnderflow);
}

}  // namespace

Ball Ball::placed(const fcl::Transform3d& pose) const {
  if (!(radius >= 0.0)) return *this;
  // Poses are rotations to 1e-9.
  const double moved = pose.translation().norm() + centre.norm();
  return {pose * centre, radius * (1.0 + 1e-8) + 1e-8 * centre.norm() + kRounding * moved};
}

Ball Ball::with(const Ball& other) const {
  if (radius < 0.0 || std::isinf(other.radius)) return other;
  if (other.radius < 0.0 || std::isinf(radius)) return *this;
  const Eigen::Vector3d middle = 0.5 * (centre + other.centre);
  const double reach =
      std::max((centre - middle).norm() + radius, (other.centre - middle).norm() + other.radius);
  return {middle, reach + kRounding * (reach + centre.norm() + other.centre.norm())};
}

Ball ballAround(const PreparedGeometry& geometry) {
  const Eigen::AlignedBox3d box = geometry.localBox();
  if (box.isEmpty()) return {Eigen::Vector3d::Zero(), -1.0};
  if (!box.sizes().allFinite()) {
    return {Eigen::Vector3d::Zero(), std::numeric_limits<double>::infinity()};
  }
  const double radius = 0.5 * box.sizes().norm();
  return {box.center(), (1.0 + kRounding) * radius + kRounding * box.center().norm()};
}

double farContactUpper(const Ball& body, const Ball& obstacle, const Displacement& displacement) {
  if (body.radius < 0.0 || obstacle.radius < 0.0) return 0.0;
  if (const auto* gaussian = std::get_if<GaussianDisplacement>(&displacement)) {
    return gaussianUpper(body, obstacle, *gaussian);
  }
  if (const auto* mixture = std::get_if<GaussianMixture>(&displacement)) {
    double upper = 0.0;
    for (const auto& component : mixture->components()) {
      upper += component.weight * gaussianUpper(body, obstacle, component.displacement);
    }
    return std::min(1.0, (1.0 + kRounding) * upper);
  }
  return 1.0;  // cut off: the partition leaves out what cannot be reached
}

}  // namespace fcl_prob::detail
