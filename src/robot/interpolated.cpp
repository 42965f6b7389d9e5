// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <cmath>
#include <string>

#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot_query.h"
#include "robot/waypoint_steps.h"

namespace fcl_prob {

namespace detail {
namespace {

/// States of a motion at most: beyond, the step is a mistake.
constexpr double kMostSteps = 1e6;

}  // namespace

std::vector<WaypointStep> stepsBetween(const std::vector<Eigen::VectorXd>& waypoints,
                                       double largest_step) {
  if (!(largest_step > 0.0)) {
    throw InvalidRequest("the largest step must be > 0, is " + numberText(largest_step));
  }
  std::vector<WaypointStep> result;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    if (waypoints[i].size() != waypoints[0].size()) {
      throw InvalidRequest("waypoint " + std::to_string(i) + " has " +
                           std::to_string(waypoints[i].size()) + " values, the first has " +
                           std::to_string(waypoints[0].size()));
    }
    if (i > 0 && waypoints[i].size() > 0) {
      const Eigen::VectorXd change = waypoints[i] - waypoints[i - 1];
      const double steps = std::ceil(change.cwiseAbs().maxCoeff() / largest_step);
      if (!(steps + static_cast<double>(result.size()) <= kMostSteps)) {
        throw InvalidRequest("steps of " + numberText(largest_step) + " from waypoint " +
                             std::to_string(i - 1) + " to " + std::to_string(i) +
                             " make more than " + numberText(kMostSteps) + " states");
      }
      for (double k = 1.0; k < steps; k += 1.0) result.push_back({i - 1, k / steps});
    }
    result.push_back({i, 0.0});
  }
  return result;
}

}  // namespace detail

std::vector<Eigen::VectorXd> interpolated(const std::vector<Eigen::VectorXd>& waypoints,
                                          double largest_step) {
  std::vector<Eigen::VectorXd> result;
  for (const detail::WaypointStep& step : detail::stepsBetween(waypoints, largest_step)) {
    result.push_back(waypoints[step.from]);
    if (step.fraction == 0.0) continue;
    result.back() += step.fraction * (waypoints[step.from + 1] - waypoints[step.from]);
  }
  return result;
}

}  // namespace fcl_prob
