// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Motions of a robot among obstacles that are predicted over time: P of every state is certainly
// below a threshold, at its time. In the library fcl_prob::planning.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fcl_prob/motion_planning.h"
#include "fcl_prob/robot_query.h"
#include "fcl_prob/self_collision.h"

namespace fcl_prob {

struct TimedWaypoint {
  double time = 0.0;       ///< seconds
  Eigen::VectorXd values;  ///< in the order of Robot::joints()
};

struct TimedPlanningRequest {
  /// How a state is decided; needs a threshold. As CertifiedPlanningRequest::state.
  ProbabilityRequest state;

  /// Of joints and base, drawn anew in every state. P is then certain by half-spaces alone
  /// (RobotQuery::decideStates()); `largest` begins at 0.
  RobotErrors errors;

  PlanningRequest planning;

  /// Seconds: of an edge states are asked for that are no further apart in time than this, nor in
  /// the joints than PlanningRequest::largest_step. > 0.
  double largest_time_step = 0.05;

  double start_time = 0.0;  ///< seconds, when the robot is at the start

  /// Seconds that the robot rests at the goal once it is there, P of which is below the threshold,
  /// too. >= 0.
  double hold = 0.0;

  /// Of the arrival at the goal, seconds; not set: as late as all obstacles are predicted, less
  /// `hold`.
  std::optional<double> latest;

  /// Of joints by name, radians or metres per second, in place of those of the URDF.
  std::map<std::string, double> velocities;

  /// Joints are no faster than this share of their velocity. In (0, 1].
  double velocity_scale = 1.0;
};

struct TimedPlan {
  PlanningStatus status = PlanningStatus::state_limit;

  /// From start to goal, each later than the one before; values are linear in time between two of
  /// them. With `hold` the goal comes twice at the end. Empty unless solved.
  std::vector<TimedWaypoint> waypoints;

  double arrival = 0.0;    ///< seconds
  double length = 0.0;     ///< in joint space: as jointLength()
  bool shortened = false;  ///< false if a limit ended the shortening, or cancelling
  std::size_t states = 0;  ///< asked

  /// Of the states of interpolated(waypoints, ...), certified; unless solved these are empty.
  Bounds largest{0.0, 1.0};     ///< contains the largest P of a state
  double likeliest_time = 0.0;  ///< seconds: of that state, by its upper bound
};

/// Whether the robot may be in a state (as of StateTest) at a time, seconds. Must answer alike
/// whenever it is asked.
using TimedStateTest = std::function<bool(double time, const Eigen::VectorXd& values)>;

/// Waypoints with so many more between them, linear in time, that neither joints nor time change by
/// more from one to the next. \throws InvalidRequest as the interpolated() of states
std::vector<TimedWaypoint> interpolated(const std::vector<TimedWaypoint>& waypoints,
                                        double largest_step, double largest_time_step);

/// Plans in joints and time, by RRT-Connect towards several times of arrival; then sooner ones are
/// looked for, and the way is shortened. No state touches the robot
/// itself, and P of each is certainly below the threshold among the obstacles as they are predicted
/// for its time (RobotQuery::at()). What is between the states is not looked at.
/// \throws InvalidRequest without a threshold; where no obstacle is predicted and `latest` is not
///         set, or one is not predicted for long enough; for a joint that is to move without a
///         velocity; for times out of order; and as planCertified()
TimedPlan planInTime(const RobotQuery& query, const SelfCollision& self,
                     const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                     const TimedPlanningRequest& request);

/// The same through states that a test allows at their times. `latest` has to be set; the request's
/// `state` and `errors` are not looked at, and `largest` is not told.
TimedPlan planInTime(const Robot& robot, const TimedStateTest& allowed,
                     const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                     const TimedPlanningRequest& request);

}  // namespace fcl_prob
