// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/state_screen.h"

#include <algorithm>
#include <numeric>

#include "base/random_words.h"
#include "base/rounded_sum.h"

namespace fcl_prob::detail {
namespace {

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
    const Obstacle& obstacle = among.obstacles()[j];
    draw(obstacle, j);
    of_bodies_.push_back(std::get<GaussianDisplacement>(obstacle.displacement).reversed());
  }
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

std::optional<bool> StateScreen::tell(const Eigen::VectorXd& values, double threshold) const {
  if (!is_usable_) return std::nullopt;
  const Near near = nearOf(values, kNegligible * threshold);
  if (isBelow(near, threshold)) return true;
  if (isHardlyBelow(near, threshold)) return false;
  return std::nullopt;
}

bool StateScreen::isBelow(const Eigen::VectorXd& values, double threshold) const {
  return is_usable_ && isBelow(nearOf(values, kNegligible * threshold), threshold);
}

bool StateScreen::isBelow(const Near& near, double threshold) const {
  const auto sumOf = [](double sum, const BodyBounds& one) { return sumAbove(sum, one.sum()); };
  const auto& all = near.of_obstacles;
  if (std::accumulate(all.begin(), all.end(), near.far, sumOf) < threshold) return true;
  // What is left of the threshold to the next obstacle, while the others have what is known.
  double so_far = near.far;
  for (auto next = all.begin(); next != all.end() && so_far < threshold; ++next) {
    const double others = std::accumulate(next + 1, all.end(), so_far, sumOf);
    so_far = sumAbove(so_far, next->together(std::max(0.0, threshold - others)));
  }
  return so_far < threshold;
}

bool StateScreen::isHardlyBelow(const Near& near, double threshold) const {
  const double enough = kTimesAsOften * threshold * kDraws + kMoreHits;
  const auto isHitBy = [&](std::size_t draw, std::size_t obstacle) {
    fcl::Transform3d moved = among_.obstacles()[obstacle].pose;
    moved.translation() += moved_[obstacle][draw];
    const auto& bounds = near.of_obstacles[obstacle].bounds();
    return std::any_of(bounds.begin(), bounds.end(), [&](const BodyBounds::Bound& bound) {
      return bound.upper >= kShareOfPair * threshold &&
             among_.preparedObstacle(obstacle).touches(
                 among_.geometries()[bound.body.body]->geometry(), bound.body.pose, moved);
    });
  };
  int hits = 0;
  for (int i = 0; i < kDraws && hits + (kDraws - i) >= enough; ++i) {
    bool is_hit = false;
    for (std::size_t j = 0; j < near.of_obstacles.size() && !is_hit; ++j) {
      is_hit = isHitBy(static_cast<std::size_t>(i), j);
    }
    hits += is_hit;
    if (hits >= enough) return true;
  }
  return false;
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
