// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/moving_obstacle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

#include "fcl_prob/exceptions.h"

namespace fcl_prob::detail {
namespace {

const GaussianDisplacement& gaussianOf(const Displacement& displacement, const std::string& what) {
  const auto* gaussian = std::get_if<GaussianDisplacement>(&displacement);
  if (gaussian == nullptr) throw InvalidRequest(what + ": its displacement is not Gaussian");
  return *gaussian;
}

std::string nameOf(const Obstacle& obstacle, std::size_t waypoint) {
  return "obstacle " + obstacle.name + " at waypoint " + std::to_string(waypoint);
}

/// What does not change stays the same to the last bit, whatever is between.
Eigen::Matrix3d turnedBetween(const Eigen::Matrix3d& first, const Eigen::Matrix3d& next,
                              double fraction) {
  if (first == next) return first;
  return Eigen::Quaterniond(first)
      .slerp(fraction, Eigen::Quaterniond(next))
      .normalized()
      .toRotationMatrix();
}

Eigen::Matrix3d covarianceBetween(const Eigen::Matrix3d& first, const Eigen::Matrix3d& next,
                                  double fraction) {
  if (first == next) return first;
  return (1.0 - fraction) * first + fraction * next;
}

ObstacleState between(const ObstacleState& first, const ObstacleState& next, double fraction) {
  if (fraction == 0.0) return first;
  const std::string what = "an obstacle between waypoints";
  const GaussianDisplacement& a = gaussianOf(first.displacement, what);
  const GaussianDisplacement& b = gaussianOf(next.displacement, what);
  ObstacleState state = first;
  state.pose.linear() = turnedBetween(first.pose.linear(), next.pose.linear(), fraction);
  state.pose.translation() =
      (1.0 - fraction) * first.pose.translation() + fraction * next.pose.translation();
  state.displacement =
      GaussianDisplacement((1.0 - fraction) * a.mean() + fraction * b.mean(),
                           covarianceBetween(a.covariance(), b.covariance(), fraction));
  return state;
}

}  // namespace

ObstacleState stateAt(const Obstacle& obstacle, std::size_t waypoint) {
  if (obstacle.over_time.empty()) return {obstacle.pose, obstacle.displacement};
  return obstacle.over_time[waypoint];
}

void requireStates(const Obstacle& obstacle, std::size_t waypoints) {
  if (obstacle.over_time.empty() || obstacle.over_time.size() == waypoints) return;
  throw InvalidRequest("obstacle " + obstacle.name + " has states at " +
                       std::to_string(obstacle.over_time.size()) + " waypoints, the motion has " +
                       std::to_string(waypoints));
}

void requireStaying(const std::vector<Obstacle>& obstacles, const std::string& what) {
  for (const Obstacle& obstacle : obstacles) {
    if (obstacle.over_time.empty()) continue;
    throw InvalidRequest("obstacle " + obstacle.name + " moves: " + what +
                         " for obstacles that stay where they are");
  }
}

std::vector<Eigen::Vector3d> offsetsSinceFirst(const Obstacle& obstacle, std::size_t waypoints) {
  std::vector<Eigen::Vector3d> offsets(waypoints, Eigen::Vector3d::Zero());
  if (obstacle.over_time.empty()) return offsets;
  const ObstacleState& first = obstacle.over_time[0];
  const GaussianDisplacement& error = gaussianOf(first.displacement, nameOf(obstacle, 0));
  for (std::size_t i = 1; i < waypoints; ++i) {
    const ObstacleState& state = obstacle.over_time[i];
    const GaussianDisplacement& then = gaussianOf(state.displacement, nameOf(obstacle, i));
    if (state.pose.linear() != first.pose.linear()) {
      throw InvalidRequest(nameOf(obstacle, i) +
                           " has turned: persistent errors are for obstacles that only shift");
    }
    if (then.covariance() != error.covariance()) {
      throw InvalidRequest(nameOf(obstacle, i) +
                           " has another covariance than at the first: its error is not persistent "
                           "(ask for independent ones, or for any dependence)");
    }
    offsets[i] = state.pose.translation() - first.pose.translation() + (then.mean() - error.mean());
  }
  return offsets;
}

double largestPosition(const Obstacle& obstacle) {
  double largest = 0.0;
  for (const ObstacleState& state : obstacle.over_time) {
    const double size = state.pose.translation().norm() +
                        gaussianOf(state.displacement, nameOf(obstacle, 0)).mean().norm();
    largest = std::max(largest, size);
  }
  return largest;
}

std::vector<ObstacleState> statesAt(const std::vector<ObstacleState>& given,
                                    const std::vector<WaypointStep>& steps) {
  std::vector<ObstacleState> states;
  if (given.empty()) return states;
  for (const WaypointStep& step : steps) {
    const std::size_t next = std::min(step.from + 1, given.size() - 1);
    states.push_back(between(given[step.from], given[next], step.fraction));
  }
  return states;
}

}  // namespace fcl_prob::detail
