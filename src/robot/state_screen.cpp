// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/state_screen.h"

#include <algorithm>
#include <numeric>

#include "base/rounded_sum.h"
#include "fcl_prob/combined_bounds.h"

namespace fcl_prob::detail {
namespace {

/// Of the threshold: a bound by balls that is smaller is not looked at more closely.
constexpr double kNegligible = 1e-4;

/// Of the threshold: where bodies that stay may have less of P, it is not worth while to know what
/// they have.
constexpr double kWorthKnowing = 0.1;

std::optional<bool> sideOf(const Bounds& known, double threshold) {
  if (known.upper < threshold) return true;
  return known.lower > threshold ? std::make_optional(false) : std::nullopt;
}

}  // namespace

StateScreen::StateScreen(const RobotAmongObstacles& among, const Eigen::VectorXd& values,
                         const std::vector<Eigen::Index>& moving)
    : StateScreen(among) {
  if (is_usable_) fixed_.emplace(among, values, moving);
}

StateScreen::StateScreen(const RobotAmongObstacles& among) : among_(among) {
  const auto have_hulls = [](const PreparedGeometries& geometries) {
    return std::all_of(geometries.begin(), geometries.end(),
                       [](const auto& geometry) { return geometry->hasRootBody(); });
  };
  is_usable_ = have_hulls(among.geometries());
  for (std::size_t j = 0; j < among.obstacles().size(); ++j) {
    const Obstacle& obstacle = among.obstacles()[j];
    is_usable_ = is_usable_ && have_hulls(among.preparedObstacle(j).geometries()) &&
                 obstacle.over_time.empty() &&
                 std::holds_alternative<GaussianDisplacement>(obstacle.displacement);
  }
  if (!is_usable_) return;
  for (std::size_t j = 0; j < among.obstacles().size(); ++j) {
    const Displacement& displacement = among.obstacles()[j].displacement;
    of_bodies_.push_back(std::get<GaussianDisplacement>(displacement).reversed());
  }
}

std::optional<bool> StateScreen::isBelow(const Eigen::VectorXd& values, double threshold,
                                         ContactMeaning contact) const {
  if (!is_usable_) return std::nullopt;
  const auto [all, far] = nearOf(among_.robot().poses(values), kNegligible * threshold);
  return sideOf(boundsOfAny(all, far, threshold, contact), threshold);
}

std::optional<bool> StateScreen::isBelow(const Eigen::VectorXd& values,
                                         const ProbabilityRequest& request) const {
  if (!is_usable_) return std::nullopt;
  const double threshold = *request.threshold;
  const std::vector<fcl::Transform3d> poses = among_.robot().poses(values);
  const Near near = nearOf(poses, kNegligible * threshold);
  const auto told =
      sideOf(boundsOfAny(near.of_obstacles, near.far, threshold, request.contact), threshold);
  if (told || !fixed_ || !fixed_->areAmong(poses)) return told;
  return sideOf(withFixed(near, request), threshold);
}

Bounds StateScreen::withFixed(const Near& near, const ProbabilityRequest& request) const {
  const auto sums = [&](bool fixed) {
    std::vector<double> by_obstacle;
    for (const BodyBounds& one : near.of_obstacles) {
      by_obstacle.push_back(one.sum([&](std::size_t i) { return fixed_->contains(i) == fixed; }));
    }
    return by_obstacle;
  };
  const std::vector<double> fixed = sums(true), moving = sums(false);
  const double of_fixed = std::accumulate(fixed.begin(), fixed.end(), 0.0);
  if (of_fixed < kWorthKnowing * *request.threshold) return {0.0, 1.0};
  auto known = fixed_->bounds(request);
  if (!known) return {0.0, 1.0};
  for (std::size_t j = 0; j < known->size(); ++j) {
    (*known)[j].upper = std::min(1.0, sumAbove((*known)[j].upper, moving[j]));
  }
  const Bounds any = anyOfIndependent(*known);
  return {any.lower, std::min(1.0, sumAbove(any.upper, near.far))};
}

StateScreen::Near StateScreen::nearOf(const std::vector<fcl::Transform3d>& poses,
                                      double negligible) const {
  Near near;
  for (std::size_t j = 0; j < among_.obstacles().size(); ++j) {
    const Obstacle& obstacle = among_.obstacles()[j];
    const PreparedObstacle& prepared = among_.preparedObstacle(j);
    const Ball around = prepared.around().placed(obstacle.pose);
    std::vector<PlacedBody> bodies;
    for (const std::size_t i : among_.bodiesOf(j)) {
      const double upper =
          farContactUpper(among_.balls()[i].placed(poses[i]), around, obstacle.displacement);
      if (upper > negligible) {
        bodies.push_back({i, poses[i]});
      } else {
        near.far = sumAbove(near.far, upper);
      }
    }
    near.of_obstacles.emplace_back(among_.prepared(), bodies, prepared, obstacle.pose,
                                   of_bodies_[j]);
  }
  return near;
}

}  // namespace fcl_prob::detail
