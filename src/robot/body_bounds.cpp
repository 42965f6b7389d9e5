// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/body_bounds.h"

#include <algorithm>
#include <numeric>

#include "base/rounded_sum.h"
#include "bounds/convex_bound.h"
#include "geometry/occupancy.h"
#include "robot/common_half_spaces.h"

namespace fcl_prob::detail {
namespace {

/// Of what would be enough: a body that is less likely to touch is not looked at more closely.
constexpr double kUnlikely = 1e-3;

/// Beyond this the hulls of a body and the obstacle meet where they are expected. Bodies of which
/// they do not are above few thresholds, and the search would take longer than all else.
constexpr double kHullsMeet = 0.5;

double upperOfPair(const PreparedGeometry& body, const fcl::Transform3d& pose,
                   const PreparedGeometry& other, const fcl::Transform3d& other_pose,
                   const GaussianDisplacement& of_bodies) {
  if (whyNeverInContact(body.geometry(), other.geometry())) return 0.0;
  if (!body.hasRootBody() || !other.hasRootBody()) return 1.0;
  return halfSpaceUpper(body.hull(), pose, other.hull(), other_pose, of_bodies);
}

}  // namespace

double upperTogether(const PreparedRobot& robot, const std::vector<PlacedBody>& bodies,
                     const LinearErrors* errors, const PreparedObstacle& obstacle,
                     const fcl::Transform3d& pose, const GaussianDisplacement& of_bodies,
                     double enough) {
  CommonHalfSpaces common =
      errors ? CommonHalfSpaces(of_bodies, *errors) : CommonHalfSpaces(of_bodies);
  const std::vector<fcl::Transform3d> poses = obstacle.poses(pose);
  for (const PlacedBody& placed : bodies) {
    const PreparedGeometry& body = *robot.geometries[placed.body];
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const PreparedGeometry& other = *obstacle.geometries()[i];
      if (whyNeverInContact(body.geometry(), other.geometry())) continue;
      if (!body.hasRootBody() || !other.hasRootBody()) return 1.0;
      common.add(robot.hulls.of(placed.body), placed.pose, obstacle.hulls().of(i), poses[i],
                 placed.body);
    }
  }
  return common.upper(enough);
}

BodyBounds::BodyBounds(const PreparedRobot& robot, const std::vector<PlacedBody>& bodies,
                       const PreparedObstacle& obstacle, const fcl::Transform3d& pose,
                       const GaussianDisplacement& of_bodies)
    : robot_(robot), obstacle_(obstacle), pose_(pose), of_bodies_(of_bodies) {
  const std::vector<fcl::Transform3d> poses = obstacle.poses(pose);
  for (const PlacedBody& body : bodies) bounds_.push_back({body, upperOf(body, poses)});
  std::stable_sort(bounds_.begin(), bounds_.end(),
                   [](const Bound& x, const Bound& y) { return x.upper > y.upper; });
}

double BodyBounds::upperOf(const PlacedBody& body,
                           const std::vector<fcl::Transform3d>& poses) const {
  double upper = 0.0;
  for (std::size_t i = 0; i < poses.size() && upper < 1.0; ++i) {
    upper = sumAbove(upper, upperOfPair(*robot_.geometries[body.body], body.pose,
                                        *obstacle_.geometries()[i], poses[i], of_bodies_));
  }
  return std::min(1.0, upper);
}

double BodyBounds::sum() const {
  return sum([](std::size_t) { return true; });
}

double BodyBounds::together(double enough) const {
  if (sum() < enough) return sum();
  std::vector<PlacedBody> near;
  double apart = 0.0;
  for (const Bound& bound : bounds_) {
    if (bound.upper < kUnlikely * enough) {
      apart = sumAbove(apart, bound.upper);
    } else {
      near.push_back(bound.body);
    }
  }
  const double of_near =
      upperTogether(robot_, near, nullptr, obstacle_, pose_, of_bodies_, enough - apart);
  return std::min(sum(), sumAbove(of_near, apart));
}

double BodyBounds::lower(ContactMeaning contact, double enough) const {
  const std::vector<fcl::Transform3d> poses = obstacle_.poses(pose_);
  for (const auto& [placed, upper] : bounds_) {
    if (upper <= std::max(enough, kHullsMeet)) break;
    const fcl::CollisionGeometryd& geometry = robot_.geometries[placed.body]->geometry();
    const PlacedBalls body{robot_.hulls.ballsOf(placed.body), placed.pose};
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (whyNeverInContact(geometry, obstacle_.geometries()[i]->geometry())) continue;
      const PlacedBalls other{obstacle_.hulls().ballsOf(i), poses[i]};
      const double lower = lowerByMedialBalls(body, other, of_bodies_, contact, enough);
      if (lower > enough) return lower;
    }
  }
  return 0.0;
}

std::vector<PlacedBody> BodyBounds::likelier(double most, double& left_out) const {
  left_out = 0.0;
  std::size_t count = bounds_.size();
  for (; count > 0; --count) {
    const double sum = sumAbove(left_out, bounds_[count - 1].upper);
    if (sum > most) break;
    left_out = sum;
  }
  std::vector<PlacedBody> bodies;
  for (std::size_t i = 0; i < count; ++i) bodies.push_back(bounds_[i].body);
  return bodies;
}

Bounds boundsOfAny(const std::vector<BodyBounds>& of_obstacles, double far, double threshold,
                   ContactMeaning contact) {
  const auto addSum = [](double sum, const BodyBounds& one) { return sumAbove(sum, one.sum()); };
  const double sum = std::accumulate(of_obstacles.begin(), of_obstacles.end(), far, addSum);
  if (sum < threshold) return {0.0, sum};
  for (const BodyBounds& one : of_obstacles) {
    if (const double lower = one.lower(contact, threshold); lower > threshold) return {lower, 1.0};
  }
  // What is left of the threshold to the next obstacle, while the others have what is known.
  double upper = far;
  for (auto next = of_obstacles.begin(); next != of_obstacles.end() && upper < threshold; ++next) {
    const double others = std::accumulate(next + 1, of_obstacles.end(), upper, addSum);
    upper = sumAbove(upper, next->together(std::max(0.0, threshold - others)));
  }
  return {0.0, upper < threshold ? upper : 1.0};
}

}  // namespace fcl_prob::detail
