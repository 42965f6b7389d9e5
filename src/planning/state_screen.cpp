// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "planning/state_screen.h"

#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "cobstacle/convex_body_data.h"
#include "cobstacle/nearest.h"
#include "fcl_prob/monte_carlo.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/constants.h"
#include "geometry/geometry_kind.h"
#include "geometry/mesh_visitor.h"
#include "montecarlo/random_samples.h"

namespace fcl_prob::detail {
namespace {

// More than what masses, their sum and the length of a unit vector are rounded by.
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

/// Of the threshold: how well P of a pair is to be known, to be added up.
constexpr double kShareOfPair = 0.05;

ConvexBody hullOfMesh(const fcl::CollisionGeometryd& geometry) {
  const MeshView mesh = meshView(geometry);
  return ConvexBody(std::vector<Eigen::Vector3d>(mesh.vertices, mesh.vertices + mesh.vertex_count));
}

double upperByHalfSpace(const CObstacle& obstacle) {
  const Eigen::Vector3d towards = gjkDirection(obstacle);
  if (!(towards.squaredNorm() > 0.5)) return 1.0;
  const double offset = -obstacle.support(-towards) * (1.0 - kMassRounding);
  if (!(offset > 0.0)) return 1.0;
  return normalTailMass(offset) * (1.0 + kMassRounding) + kUnderflow;
}

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
  for (const RobotBody& body : query.robot().bodies()) {
    for (const Obstacle& obstacle : query.obstacles()) {
      queries_.emplace_back(body.geometry, obstacle.geometry);
    }
  }
}

void StateScreen::add(const std::shared_ptr<const fcl::CollisionGeometryd>& geometry,
                      std::vector<Hull>& to) {
  const PreparedGeometry prepared(geometry, "a geometry");
  if (!prepared.hasRootBody()) {
    is_usable_ = false;
    return;
  }
  const bool is_mesh = kindOf(*geometry) == GeometryKind::mesh;
  to.push_back({is_mesh ? hullOfMesh(*geometry) : prepared.rootBody(), ballAround(prepared)});
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

double StateScreen::upperOfPair(const Hull& hull, const fcl::Transform3d& pose,
                                std::size_t obstacle) const {
  const Hull& other = obstacles_[obstacle];
  const PairFrame frame = pairFrame(hull.body, pose, other.body, query_.obstacles()[obstacle].pose,
                                    displacements_[obstacle]);
  if (frame.rank < 3 || !frame.fits) return 1.0;
  return upperByHalfSpace(*PairObstacle(frame, hull.body.data(), other.body.data()));
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
      if (upper > negligible) upper = std::min(upper, upperOfPair(bodies_[i], poses[i], j));
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

Bounds StateScreen::ask(const Pair& pair, const fcl::Transform3d& pose,
                        const ProbabilityRequest& request) const {
  ProbabilityResult result;
  queries_[pair.body * obstacles_.size() + pair.obstacle].collisionProbability(
      pose, query_.obstacles()[pair.obstacle].pose, displacements_[pair.obstacle], request, result);
  return {result.lower.value_or(0.0), std::min(pair.upper, result.upper.value_or(1.0))};
}

Decision StateScreen::decide(const Eigen::VectorXd& values,
                             const ProbabilityRequest& request) const {
  if (!is_usable_) return Decision::undecided;
  const double threshold = *request.threshold;
  const std::vector<fcl::Transform3d> poses = query_.robot().poses(values);
  std::vector<Pair> pairs =
      *pairsBelow(poses, kNegligible * threshold, std::numeric_limits<double>::infinity());
  const auto likeliestFirst = [](const Pair& x, const Pair& y) { return x.upper > y.upper; };
  const auto isSumBelow = [&] {
    double sum = 0.0;
    for (const Pair& pair : pairs) sum += pair.upper;
    return sum * (1.0 + kMassRounding) < threshold;
  };
  ProbabilityRequest interval = request;
  interval.threshold.reset();
  interval.absolute_tolerance = std::max(request.absolute_tolerance, kShareOfPair * threshold);
  // First what a decision costs, then what is needed to add up.
  for (const ProbabilityRequest& of_pair : {std::cref(request), std::cref(interval)}) {
    std::stable_sort(pairs.begin(), pairs.end(), likeliestFirst);
    for (Pair& pair : pairs) {
      if (isSumBelow()) return Decision::below;
      if (pair.upper < kShareOfPair * threshold) break;
      const Bounds bounds = ask(pair, poses[pair.body], of_pair);
      if (bounds.lower > threshold) return Decision::above;
      pair.upper = bounds.upper;
    }
  }
  return isSumBelow() ? Decision::below : Decision::undecided;
}

}  // namespace fcl_prob::detail
