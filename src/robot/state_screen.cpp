// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/state_screen.h"

#include <algorithm>
#include <limits>

#include "base/random_words.h"
#include "robot/body_bounds.h"

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
    at_.push_back(among.preparedObstacle(j).poses(obstacle.pose));
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
  const std::vector<fcl::Transform3d> poses = among_.robot().poses(values);
  if (isBelow(poses, threshold)) return true;
  if (isHardlyBelow(poses, threshold)) return false;
  return std::nullopt;
}

bool StateScreen::isBelow(const Eigen::VectorXd& values, double threshold) const {
  return is_usable_ && isBelow(among_.robot().poses(values), threshold);
}

bool StateScreen::isHardlyBelow(const Eigen::VectorXd& values, double threshold) const {
  return is_usable_ && isHardlyBelow(among_.robot().poses(values), threshold);
}

bool StateScreen::isBelow(const std::vector<fcl::Transform3d>& poses, double threshold) const {
  return pairsBelow(poses, kNegligible * threshold, threshold).has_value();
}

bool StateScreen::isHardlyBelow(const std::vector<fcl::Transform3d>& poses,
                                double threshold) const {
  const auto near =
      pairsBelow(poses, kNegligible * threshold, std::numeric_limits<double>::infinity());
  const double enough = kTimesAsOften * threshold * kDraws + kMoreHits;
  const auto isHit = [&](std::size_t draw) {
    return std::any_of(near->begin(), near->end(), [&](const Pair& pair) {
      if (pair.upper < kShareOfPair * threshold) return false;
      fcl::Transform3d moved = among_.obstacles()[pair.obstacle].pose;
      moved.translation() += moved_[pair.obstacle][draw];
      return among_.preparedObstacle(pair.obstacle)
          .touches(among_.geometries()[pair.body]->geometry(), poses[pair.body], moved);
    });
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
  for (std::size_t j = 0; j < among_.obstacles().size(); ++j) {
    const Obstacle& obstacle = among_.obstacles()[j];
    const PreparedObstacle& prepared = among_.preparedObstacle(j);
    const Ball around = prepared.around().placed(obstacle.pose);
    for (const std::size_t i : among_.bodiesOf(j)) {
      double upper =
          farContactUpper(among_.balls()[i].placed(poses[i]), around, obstacle.displacement);
      if (upper > negligible) {
        upper = std::min(
            upper, bodyUpper(*among_.geometries()[i], poses[i], prepared, at_[j], of_bodies_[j]));
      }
      pairs.push_back({i, j, upper});
      sum += upper;
      if (!(sum * (1.0 + kMassRounding) < enough)) return std::nullopt;
    }
  }
  return pairs;
}

}  // namespace fcl_prob::detail
