// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/state_screen.h"

#include <algorithm>

#include "base/rounded_sum.h"

namespace fcl_prob::detail {
namespace {

/// Of the threshold: a bound by balls that is smaller is not looked at more closely.
constexpr double kNegligible = 1e-4;

}  // namespace

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
  const auto [all, far] = nearOf(values, kNegligible * threshold);
  const Bounds known = boundsOfAny(all, far, threshold, contact);
  if (known.upper < threshold) return true;
  return known.lower > threshold ? std::make_optional(false) : std::nullopt;
}

StateScreen::Near StateScreen::nearOf(const Eigen::VectorXd& values, double negligible) const {
  const std::vector<fcl::Transform3d> poses = among_.robot().poses(values);
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
