// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How likely a robot touches anything at each waypoint of a motion, and which of them to look at.
#pragma once

#include <vector>

#include "fcl_prob/robot_query.h"

namespace fcl_prob::cli {

/// A waypoint by itself.
struct MotionState {
  std::size_t waypoint = 0;
  RobotResult result;
};

/// All waypoints, each to the tolerance of the request; a threshold has no part in it. \throws as
/// RobotQuery::state()
std::vector<MotionState> statesOf(const RobotQuery& query,
                                  const std::vector<Eigen::VectorXd>& waypoints,
                                  ProbabilityRequest request);

/// The state with the largest probability, the first of several. There must be one.
std::size_t likeliestOf(const std::vector<MotionState>& states);

/// So many of them, evenly from the first to the last, but the likeliest one in place of the one
/// nearest to it: a motion may be dangerous for a short time only.
std::vector<MotionState> chosenFrom(const std::vector<MotionState>& states, std::size_t count);

}  // namespace fcl_prob::cli
