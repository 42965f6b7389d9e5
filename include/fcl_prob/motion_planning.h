// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Motions of a robot through states that a test allows. In the library fcl_prob::planning, the only
// part that needs OMPL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fcl_prob/robot.h"

namespace fcl_prob {

/// Whether the robot may be in a state (values in the order of Robot::joints()). Must answer alike
/// whenever it is asked.
using StateTest = std::function<bool(const Eigen::VectorXd& values)>;

struct PlanningProgress {
  std::size_t states = 0;  ///< asked
  double seconds = 0.0;
  bool shortening = false;  ///< there is a path, which is being shortened
};

struct PlanningRequest {
  /// The joints that may move; none named: all. The values of the others are those of the start.
  std::vector<std::string> joints;

  /// What is asked of an edge: states at its ends and between, linear in the joints, so that no
  /// joint moves further at once (radians, metres), as interpolated() makes them. > 0.
  double largest_step = 0.05;

  /// The same seed gives the same path, however many plans are made at once.
  std::uint64_t seed = 1;

  /// States to ask for at most, those for shortening included; at least 1.
  std::size_t max_states = 200'000;

  /// Seconds; not set means no limit, so that results repeat.
  std::optional<double> time_limit;

  /// Shorten the path that the planner finds, and look for shorter ones with up to half of the
  /// states and of the time.
  bool shorten = true;

  /// Told from time to time; returns false to stop. Empty: nobody is told.
  std::function<bool(const PlanningProgress&)> on_progress;
};

/// Why a plan ended.
enum class PlanningStatus {
  solved,
  start_refused,  ///< by the test
  goal_refused,   ///< by the test
  state_limit,    ///< without a path
  time_limit,     ///< without a path
  cancelled,      ///< without a path
  threshold       ///< planCertified(): no path found is below the threshold of a whole motion
};

std::string toString(PlanningStatus status);

struct PlanningResult {
  PlanningStatus status = PlanningStatus::state_limit;

  /// From start to goal; between two of them values are linear. Empty unless solved.
  std::vector<Eigen::VectorXd> waypoints;

  double length = 0.0;          ///< of that path: jointLength()
  double planned_length = 0.0;  ///< before it was shortened

  /// False if a limit ended the shortening, or cancelling.
  bool shortened = false;

  std::size_t states = 0;  ///< asked
};

/// The sum over the edges of the Euclidean length in joint space (radians and metres alike).
double jointLength(const std::vector<Eigen::VectorXd>& waypoints);

/// A path from start to goal of which the test allows every state that it was asked for: those of
/// interpolated(waypoints, largest_step). By OMPL's RRT-Connect; then by short cuts, and
/// waypoints pulled towards the straight line between their neighbours as far as the test allows;
/// then by further trees where shorter paths pass, as long as they find some.
///
/// Joints stay within their limits; continuous ones within half a turn of what is between start and
/// goal, whose values are taken as they are (no whole turns are left out). What cannot be reached
/// is not told from what was not found. \throws InvalidRequest for values that are not one finite
/// number a joint or beyond a limit, a
///         joint that is not there, a joint that differs between start and goal but may not move, a
///         step or a limit that is not > 0
PlanningResult planMotion(const Robot& robot, const StateTest& allowed,
                          const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                          const PlanningRequest& request = {});

}  // namespace fcl_prob
