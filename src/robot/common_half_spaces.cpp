// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/common_half_spaces.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "convex/nearest.h"
#include "convex/pair_obstacle.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob::detail {
namespace {

// More than what a mass, a sum of a few and the length of a unit vector are rounded by.
constexpr double kRoundedMass = 1e-9;

// More than what turns and the points that are turned are rounded by, relative to them.
constexpr double kRoundedTurn = 1e-8;

constexpr double kEighthTurn = 0.78539816339744831;

/// Of what the half-spaces have: what pairs that are not held yet may add without being divided.
constexpr double kHardly = 0.01;

/// Pairs that are divided at most: about as long as a partition takes to begin with.
constexpr int kMostDivided = 100;

double massBehind(double distance) {
  if (!(distance > 0.0)) return 1.0;
  return normalTailMass(distance) * (1.0 + kRoundedMass) + kUnderflow;
}

}  // namespace

void CommonHalfSpaces::add(const NodeHulls& a, const fcl::Transform3d& pose_a, const NodeHulls& b,
                           const fcl::Transform3d& pose_b, std::size_t body) {
  bodies_.push_back({a, b, PairFrame(displacement_, pose_a, a.size, pose_b, b.size), pose_a, body});
  PairFrame& frame = bodies_.back().frame;
  frame.error += a.slack + b.slack + (errors_ ? errors_->of(body).reach : 0.0);
  can_tell_ = can_tell_ && frame.rank == 3 && frame.fits;
  if (!can_tell_) return;
  Pair whole;
  whole.of = bodies_.size() - 1;
  whole.a = whole.b = 0;
  open(std::move(whole), 1.0);
}

/// The point of the node that is farthest along the direction, and what the errors of the robot
/// move it by, in deviations along that.
CommonHalfSpaces::Foremost CommonHalfSpaces::foremost(const Pair& pair,
                                                      const Eigen::Vector3d& towards) const {
  if (!errors_) return {};
  const Bodies& bodies = bodies_[pair.of];
  const LinearErrors::OfBody& errors = errors_->of(bodies.body);
  const Eigen::Vector3d m = bodies.frame.whitening.transpose() * towards;
  const Eigen::Vector3d point = farthestOf(pair, m);
  const Eigen::Vector3d arm = point - errors.centre;
  return {point, errors.shift.transpose() * m + errors.turn.transpose() * arm.cross(m)};
}

Eigen::Vector3d CommonHalfSpaces::farthestOf(const Pair& pair, const Eigen::Vector3d& m) const {
  const Bodies& bodies = bodies_[pair.of];
  const ConvexBody& hull = bodies.a.nodes[pair.a].hull;
  return bodies.pose_a * hull.supportPoint(bodies.pose_a.linear().transpose() * m);
}

/// How much farther than by that point the node may reach when it turns. With ω the turn its
/// support along m becomes h(m + u) - u·p, u = m × ω, which is convex in u: its largest value over
/// an ellipse of turns is no more than that at the corners of an octagon around it.
double CommonHalfSpaces::turnedBeyond(const Pair& pair, const Eigen::Vector3d& towards,
                                      const Eigen::Vector3d& point) const {
  const Bodies& bodies = bodies_[pair.of];
  const Eigen::Vector3d m = bodies.frame.whitening.transpose() * towards;
  const Eigen::Matrix3Xd& turn = errors_->of(bodies.body).turn;
  Eigen::Matrix3Xd turned(3, turn.cols());
  for (Eigen::Index k = 0; k < turn.cols(); ++k) turned.col(k) = m.cross(turn.col(k));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(turned * turned.transpose());
  const double scale = errors_->within() / std::cos(kEighthTurn / 2.0) * (1.0 + kRoundedTurn);
  const Eigen::Vector3d semiaxes = scale * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  double beyond = 0.0;
  for (int k = 0; k < 8; ++k) {
    const double angle = k * kEighthTurn;
    const Eigen::Vector3d u = std::cos(angle) * semiaxes[2] * solver.eigenvectors().col(2) +
                              std::sin(angle) * semiaxes[1] * solver.eigenvectors().col(1);
    beyond = std::max(beyond, (m + u).dot(farthestOf(pair, m + u) - point));
  }
  return beyond + 2.0 * (bodies.a.slack + kRoundedTurn * bodies.a.size) * semiaxes[2];
}

double CommonHalfSpaces::distanceAlong(const Pair& pair, const Direction& direction) const {
  const Bodies& bodies = bodies_[pair.of];
  const PairObstacle obstacle(bodies.frame, bodies.a.nodes[pair.a].hull.set(),
                              bodies.b.nodes[pair.b].hull.set());
  double distance = -obstacle->support(-direction.towards) * (1.0 - kRoundedMass);
  if (!errors_) return distance;
  const Foremost own = foremost(pair, direction.towards);
  // What the direction does not have of the point's errors is at most its length times that of z.
  distance -= (1.0 + kRoundedMass) * (turnedBeyond(pair, direction.towards, own.point) +
                                      errors_->within() * (own.errors - direction.along).norm());
  return distance / std::sqrt(1.0 + direction.along.squaredNorm()) * (1.0 - kRoundedMass);
}

void CommonHalfSpaces::open(Pair pair, double most) {
  pair.own = most;
  pair.distances.clear();
  for (const HalfSpace& one : half_spaces_) {
    pair.distances.push_back(distanceAlong(pair, one.direction));
    if (pair.distances.back() >= one.distance) return;
  }
  const Bodies& bodies = bodies_[pair.of];
  const PairObstacle obstacle(bodies.frame, bodies.a.nodes[pair.a].hull.set(),
                              bodies.b.nodes[pair.b].hull.set());
  const Eigen::Vector3d towards = gjkDirection(*obstacle);
  if (towards.squaredNorm() > 0.5) {
    Direction direction{towards, foremost(pair, towards).errors};
    const double own = massBehind(distanceAlong(pair, direction));
    if (own < most) {
      pair.direction = std::move(direction);
      pair.own = own;
    }
  }
  appraise(pair);
  pairs_.push_back(std::move(pair));
}

void CommonHalfSpaces::appraise(Pair& pair) const {
  pair.cost = pair.own;
  pair.cheapest = -1;
  for (std::size_t i = 0; i < half_spaces_.size(); ++i) {
    const double distance = std::min(pair.distances[i], half_spaces_[i].distance);
    const double more = massBehind(distance) - half_spaces_[i].mass;
    if (more < pair.cost) {
      pair.cost = std::max(0.0, more);
      pair.cheapest = static_cast<int>(i);
    }
  }
}

bool CommonHalfSpaces::isLeaf(const Pair& pair) const {
  return bodies_[pair.of].a.nodes[pair.a].isLeaf() && bodies_[pair.of].b.nodes[pair.b].isLeaf();
}

void CommonHalfSpaces::divide(const Pair& pair) {
  const NodeHulls::Node& a = bodies_[pair.of].a.nodes[pair.a];
  const NodeHulls::Node& b = bodies_[pair.of].b.nodes[pair.b];
  const bool divides_a = b.isLeaf() || (!a.isLeaf() && a.ball.radius > b.ball.radius);
  for (const int child : {divides_a ? a.left : b.left, divides_a ? a.right : b.right}) {
    Pair of_child = pair;
    (divides_a ? of_child.a : of_child.b) = child;
    open(std::move(of_child), pair.own);
  }
}

void CommonHalfSpaces::hold(const Pair& pair) {
  if (pair.cheapest < 0) {
    const double distance = distanceAlong(pair, pair.direction);
    half_spaces_.push_back({pair.direction, distance, massBehind(distance)});
    for (Pair& other : pairs_) {
      other.distances.push_back(distanceAlong(other, pair.direction));
    }
  } else {
    HalfSpace& one = half_spaces_[pair.cheapest];
    one.distance = std::min(one.distance, pair.distances[pair.cheapest]);
    one.mass = massBehind(one.distance);
  }
  for (Pair& other : pairs_) appraise(other);
}

double CommonHalfSpaces::held() const {
  double sum = 0.0;
  for (const HalfSpace& one : half_spaces_) sum += one.mass;
  return sum;
}

double CommonHalfSpaces::upper(double enough) {
  if (!can_tell_) return 1.0;
  const auto sum = [this] {
    double sum = held();
    for (const Pair& pair : pairs_) sum += pair.cost;
    return std::min(1.0, sum * (1.0 + kRoundedMass));
  };
  double least = sum();  // a body may have less than its parts in sum
  for (int divided = 0; divided < kMostDivided && !pairs_.empty();) {
    if (least < enough || !(held() < enough)) break;
    const auto most = std::max_element(
        pairs_.begin(), pairs_.end(), [](const Pair& x, const Pair& y) { return x.cost < y.cost; });
    if (most->cost * static_cast<double>(pairs_.size()) < kHardly * held()) break;
    std::swap(*most, pairs_.back());
    const Pair pair = std::move(pairs_.back());
    pairs_.pop_back();
    if (isLeaf(pair)) {
      hold(pair);
    } else {
      divide(pair);
      ++divided;
    }
    least = std::min(least, sum());
  }
  return least;
}

}  // namespace fcl_prob::detail
