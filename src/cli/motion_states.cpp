// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/motion_states.h"

#include <algorithm>

#include "cli/progress_bar.h"
#include "robot/moving_obstacle.h"

namespace fcl_prob::cli {
namespace {

/// The obstacles as they are at a waypoint, if they move.
RobotQuery standingAt(const RobotQuery& query, std::size_t waypoint) {
  std::vector<Obstacle> obstacles = query.obstacles();
  for (Obstacle& obstacle : obstacles) {
    obstacle = detail::standing(obstacle, detail::stateAt(obstacle, waypoint));
  }
  return query.withObstacles(std::move(obstacles));
}

std::size_t distanceBetween(std::size_t a, std::size_t b) { return a < b ? b - a : a - b; }

}  // namespace

std::vector<MotionState> statesOf(const RobotQuery& query,
                                  const std::vector<Eigen::VectorXd>& waypoints,
                                  ProbabilityRequest request) {
  request.threshold.reset();
  const auto& obstacles = query.obstacles();
  const bool any_moves =
      std::any_of(obstacles.begin(), obstacles.end(),
                  [](const Obstacle& obstacle) { return !obstacle.over_time.empty(); });
  ProgressBar bar("fcl_prob export");
  std::vector<MotionState> states;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    bar.show(static_cast<double>(i) / static_cast<double>(waypoints.size()),
             std::to_string(i) + " of " + std::to_string(waypoints.size()) + " waypoints");
    states.push_back({i, any_moves ? standingAt(query, i).state(waypoints[i], request)
                                   : query.state(waypoints[i], request)});
  }
  return states;
}

std::size_t likeliestOf(const std::vector<MotionState>& states) {
  const auto less = [](const MotionState& a, const MotionState& b) {
    return a.result.probability() < b.result.probability();
  };
  return static_cast<std::size_t>(std::max_element(states.begin(), states.end(), less) -
                                  states.begin());
}

std::vector<MotionState> chosenFrom(const std::vector<MotionState>& states, std::size_t count) {
  if (count >= states.size()) return states;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i) {
    chosen.push_back(count == 1 ? 0 : i * (states.size() - 1) / (count - 1));
  }
  const std::size_t likeliest = likeliestOf(states);
  *std::min_element(chosen.begin(), chosen.end(), [&](std::size_t a, std::size_t b) {
    return distanceBetween(a, likeliest) < distanceBetween(b, likeliest);
  }) = likeliest;
  std::vector<MotionState> result;
  for (const std::size_t i : chosen) result.push_back(states[i]);
  return result;
}

}  // namespace fcl_prob::cli
