// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/moving_obstacle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "base/number_text.h"
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

bool isPredicted(const std::vector<ObstacleState>& over_time) {
  return !over_time.empty() && over_time[0].time.has_value();
}

Obstacle standing(Obstacle obstacle, const ObstacleState& state) {
  obstacle.pose = state.pose;
  obstacle.displacement = state.displacement;
  obstacle.over_time.clear();
  return obstacle;
}

void requireTimes(const Obstacle& obstacle) {
  const auto fail = [&](std::size_t i, const std::string& fault) {
    throw InvalidRequest("obstacle " + obstacle.name + ": over_time: state " + std::to_string(i) +
                         " " + fault);
  };
  const bool predicted = isPredicted(obstacle.over_time);
  for (std::size_t i = 0; i < obstacle.over_time.size(); ++i) {
    const std::optional<double>& time = obstacle.over_time[i].time;
    if (time.has_value() != predicted) fail(i, predicted ? "has no time" : "has a time");
    if (time && !std::isfinite(*time)) fail(i, "has a time that is not finite");
    if (!time || i == 0 || *time > *obstacle.over_time[i - 1].time) continue;
    fail(i, "is at " + numberText(*time) + " s, the one before at " +
                numberText(*obstacle.over_time[i - 1].time) + " s: times have to increase");
  }
}

ObstacleState predictedAt(const Obstacle& obstacle, double time) {
  const std::vector<ObstacleState>& states = obstacle.over_time;
  if (!(time >= *states.front().time && time <= *states.back().time)) {
    throw InvalidRequest("obstacle " + obstacle.name + " is predicted from " +
                         numberText(*states.front().time) + " s to " +
                         numberText(*states.back().time) + " s, not at " + numberText(time) + " s");
  }
  const auto next =
      std::upper_bound(states.begin() + 1, states.end(), time,
                       [](double at, const ObstacleState& state) { return at < *state.time; });
  const ObstacleState& first = *(next - 1);
  if (next == states.end()) return first;
  ObstacleState state = between(first, *next, (time - *first.time) / (*next->time - *first.time));
  state.time = time;
  return state;
}

ObstacleState stateAt(const Obstacle& obstacle, std::size_t waypoint) {
  if (obstacle.over_time.empty()) return {obstacle.pose, obstacle.displacement};
  return obstacle.over_time[waypoint];
}

void requireStates(const Obstacle& obstacle, std::size_t waypoints) {
  if (obstacle.over_time.empty() || obstacle.over_time.size() == waypoints) return;
  if (isPredicted(obstacle.over_time)) {
    throw InvalidRequest("obstacle " + obstacle.name +
                         " is predicted over time: ask RobotQuery::at() for a time first");
  }
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
