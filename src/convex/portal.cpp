// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/portal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <utility>

namespace fcl_prob::detail {
namespace {

// A search that takes longer has met rounding.
constexpr int kDiscoverySteps = 40;

// Tangent of the angle by which the first support directions lean towards the ray.
constexpr double kLean = 0.5;

}  // namespace

Portal::Portal(const SupportObstacle& obstacle, const Eigen::Vector3d& origin,
               const Eigen::Vector3d& direction)
    : obstacle_(obstacle),
      origin_(origin),
      direction_(direction),
      slack_(std::numeric_limits<double>::infinity()),
      found_((discover(kLean) || discover(0.0)) && orient()) {}

// Seen along the ray, the origin is inside V: a triangle of support points around it is looked for
// as in two dimensions, by a segment that turns towards the origin. The support directions lean
// towards the ray's, so that the triangle is already far along the ray. Where the body has an apex
// or a corner, leaning directions may all find the same point; upright ones do not.
bool Portal::discover(double lean) {
  auto& [a, b, c] = corners_;
  const Eigen::Vector3d along = direction_.normalized();
  const auto support = [&](const Eigen::Vector3d& across, double leaning) -> Eigen::Vector3d {
    return obstacle_.supportPoint(across + leaning * across.norm() * along) - origin_;
  };
  // Not in the ray's own direction: on a ball the ray would pass through that corner for ever.
  a = support(direction_.unitOrthogonal(), 4.0 * lean);
  Eigen::Vector3d side = along * along.dot(a) - a;
  if (side.isZero(0.0)) side = direction_.unitOrthogonal();
  b = support(side, lean);
  if (direction_.dot(a.cross(b)) < 0.0) std::swap(a, b);
  for (int step = 0; step < kDiscoverySteps; ++step) {
    side = along.cross(b - a);
    c = support(side, lean);
    if (!(side.dot(c) > 0.0)) c = support(side, 0.0);
    if (!(side.dot(c) > 0.0)) return false;
    if (direction_.dot(b.cross(c)) < 0.0) {
      a = c;
    } else if (direction_.dot(c.cross(a)) < 0.0) {
      b = c;
    } else {
      return true;
    }
  }
  return false;
}

// Computes the normal; false if the triangle is too thin to have one.
bool Portal::orient() {
  const auto& [a, b, c] = corners_;
  const Eigen::Vector3d area = (b - a).cross(c - a);
  const double length = area.norm();
  if (!(length > 1e-280)) return false;
  normal_ = area / length;
  return normal_.dot(direction_) > 0.0;
}

bool Portal::refine() {
  auto& [a, b, c] = corners_;
  const Eigen::Vector3d p = obstacle_.supportPoint(normal_) - origin_;
  slack_ = std::max(0.0, normal_.dot(p - a));
  if (p == a || p == b || p == c) return false;
  // The ray is in one of the cones over (p, a, b), (p, b, c) and (p, c, a).
  const Eigen::Vector3d across = direction_.cross(p);
  const bool past_a = across.dot(a) > 0.0;
  const bool past_b = across.dot(b) > 0.0;
  const bool past_c = across.dot(c) > 0.0;
  const std::array<Eigen::Vector3d, 3> before = corners_;
  if (past_b && !past_c) {
    a = p;
  } else if (past_c && !past_a) {
    b = p;
  } else {
    c = p;  // also if the ray passes through p
  }
  const Eigen::Vector3d normal_before = normal_;
  if (orient()) return true;
  corners_ = before;
  normal_ = normal_before;
  return false;
}

// Barycentric coordinates of where the line pierces the triangle, up to a factor.
std::array<double, 3> Portal::weights() const {
  const auto& [a, b, c] = corners_;
  return {std::max(0.0, direction_.dot(b.cross(c))), std::max(0.0, direction_.dot(c.cross(a))),
          std::max(0.0, direction_.dot(a.cross(b)))};
}

Eigen::Vector3d Portal::piercedPoint() const {
  const std::array<double, 3> w = weights();
  const double sum = w[0] + w[1] + w[2];
  if (!(sum > 0.0)) return origin_ + corners_[0];
  return origin_ + (w[0] * corners_[0] + w[1] * corners_[1] + w[2] * corners_[2]) / sum;
}

bool Portal::holds(const Eigen::Vector3d& point, Eigen::Vector3d& combination) const {
  const Eigen::Vector3d pierced = piercedPoint() - origin_;
  const double share = direction_.dot(point - origin_) / direction_.dot(pierced);
  if (!(share >= 0.0 && share <= 1.0)) return false;
  combination = origin_ + share * pierced;
  return true;
}

}  // namespace fcl_prob::detail
