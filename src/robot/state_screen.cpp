// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "planning/state_screen.h"

#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <limits>

#include "base/random_words.h"
#include "bounds/convex_bound.h"
#include "fcl_prob/monte_carlo.h"
#include "query/prepared_geometry.h"

namespace fcl_prob::detail {
namespace {

// More than what a sum of masses is rounded by.
constexpr double kMassRounding = 1e-9;

/// Of the threshold: a bound by balls that is smaller is not looked at more closely.
constexpr double kNegligible = 1e-4;

/// Displacements that are drawn of each obstacle. With P at a threshold of 5 % a state is taken for
/// hardly below it once in a thousand times.
constexpr int kDraws = 160;

/// A state is hardly below the threshold where draws hit this many times as often, and so many
/// more.
constexpr double kTimesAsOften = 1.6;
constexpr double kMoreHits = 5.0;

/// Of the threshold: displaced obstacles of a pair that is less likely are not tried.
constexpr double kShareOfPair = 0.05;

}  // namespace

StateScreen::StateScreen(const RobotQuery& query) : query_(query) {
  for (const RobotBody& body : query.robot().bodies()) add(body.geometry, bodies_);
  for (const Obstacle& obstacle : query.obstacles()) {
    add(obstacle.geometry, obstacles_);
    is_usable_ = is_usable_ && obstacle.over_time.empty();
    const auto* gaussian = std::get_if<GaussianDisplacement>(&obstacle.displacement);
    is_usable_ = is_usable_ && gaussian != nullptr;
    if (gaussian != nullptr) displacements_.push_back(gaussian->reversed());
  }
  if (!is_usable_) return;
  for (std::size_t j = 0; j < query.obstacles().size(); ++j) draw(query.obstacles()[j], j);
}

void StateScreen::add(const std::shared_ptr<const fcl::CollisionGeometryd>& geometry,
                      std::vector<Hull>& to) {
  const PreparedGeometry prepared(geometry, "a geometry");
  if (!prepared.hasRootBody()) {
    is_usable_ = false;
    return;
  }
  to.push_back({prepared.hull(), ballAround(prepared)});
}

void StateScreen::draw(const Obstacle& obstacle, std::uint64_t stream) {
  const auto& gaussian = std::get<GaussianDisplacement>(obstacle.displacement);
  const Eigen::Matrix3d factor = gaussian.axes() * gaussian.standardDeviations().asDiagonal();
  std::vector<Eigen::Vector3d> moved;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const Eigen::Vector3d normal = standardNormalFrom(randomWords({kDraws, stream}, i));
    moved.push_back(gaussian.mean() + factor * normal);
  }
  moved_.push_back(std::move(moved));
}

bool StateScreen::isHardlyBelow(const Eigen::VectorXd& values, double threshold) const {
  if (!is_usable_) return false;
  const std::vector<fcl::Transform3d> poses = query_.robot().poses(values);
  const auto near =
      pairsBelow(poses, kNegligible * threshold, std::numeric_limits<double>::infinity());
  const double enough = kTimesAsOften * threshold * kDraws + kMoreHits;
  const auto isHit = [&](std::size_t draw) {
    for (const Pair& pair : *near) {
      if (pair.upper < kShareOfPair * threshold) continue;
      const Obstacle& obstacle = query_.obstacles()[pair.obstacle];
      const auto& body = query_.robot().bodies()[pair.body].geometry;
      if (!fclSupportsPair(*body, *obstacle.geometry)) continue;
      fcl::Transform3d moved = obstacle.pose;
      moved.translation() += moved_[pair.obstacle][draw];
      fcl::CollisionResultd result;
      if (fcl::collide(body.get(), poses[pair.body], obstacle.geometry.get(), moved,
                       fcl::CollisionRequestd(), result) > 0) {
        return true;
      }
    }
    return false;
  };
  int hits = 0;
  for (int i = 0; i < kDraws && hits + (kDraws - i) >= enough; ++i) {
    hits += isHit(static_cast<std::size_t>(i));
    if (hits >= enough) return true;
  }
  return false;
}

std::optional<std::vector<StateScreen::Pair>> StateScreen::pairsBelow(
    const std::vector<fcl::Transform3d>& poses, double negligible, double enough) const {
  std::vector<Pair> pairs;
  double sum = 0.0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Ball ball = bodies_[i].ball.placed(poses[i]);
    for (std::size_t j = 0; j < obstacles_.size(); ++j) {
      const Obstacle& obstacle = query_.obstacles()[j];
      double upper =
          farContactUpper(ball, obstacles_[j].ball.placed(obstacle.pose), obstacle.displacement);
      if (upper > negligible) {
        upper = std::min(upper, halfSpaceUpper(bodies_[i].body, poses[i], obstacles_[j].body,
                                               obstacle.pose, displacements_[j]));
      }
      pairs.push_back({i, j, upper});
      sum += upper;
      if (!(sum * (1.0 + kMassRounding) < enough)) return std::nullopt;
    }
  }
  return pairs;
}

bool StateScreen::isBelow(const Eigen::VectorXd& values, double threshold) const {
  if (!is_usable_) return false;
  const auto poses = query_.robot().poses(values);
  return pairsBelow(poses, kNegligible * threshold, threshold).has_value();
}

}  // namespace fcl_prob::detail
