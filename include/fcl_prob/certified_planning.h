// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Motions of a robot at every state of which P(it touches anything) is certainly below a threshold.
// In the library fcl_prob::planning.
#pragma once

#include "fcl_prob/motion_planning.h"
#include "fcl_prob/robot_query.h"
#include "fcl_prob/self_collision.h"

namespace fcl_prob {

struct CertifiedPlanningRequest {
  /// How a state is decided; needs a threshold, which P of every state stays below. A state whose
  /// decision a limit of this request leaves open is not allowed: `max_cells` bounds what those
  /// near the threshold cost.
  ProbabilityRequest state;

  /// P(the whole motion touches anything), errors being the same all along, stays below this, too,
  /// in (0, 1]; not set: it may be anything.
  std::optional<double> motion_threshold;

  /// Where a path is not below that, its waypoints are moved along the gradient of P (NLopt) before
  /// another path is looked for.
  bool descend = true;

  /// Of joints and base, drawn anew in every state. P is then certain by half-spaces alone
  /// (RobotQuery::decideStates()); `largest` begins at 0.
  RobotErrors errors;

  PlanningRequest planning;
};

struct CertifiedPlan {
  PlanningResult path;

  /// What every state of the path is below: the threshold of the request, halved for each attempt
  /// whose whole motion was not below `motion_threshold`.
  double state_threshold = 0.0;

  /// The path was moved along the gradient of P to get there.
  bool descended = false;

  /// Unless solved, these are empty. All are of the states of
  /// interpolated(path.waypoints, largest_step), certified.
  Bounds largest{0.0, 1.0};   ///< contains the largest P of a state
  std::size_t likeliest = 0;  ///< the state that it is of, by its upper bound
  Bounds motion{0.0, 1.0};    ///< P that any of them touches, errors being the same all along; with
                              ///< errors of the robot nothing is told of it
};

/// Plans as planMotion() does: no state that was asked for touches the robot itself, and P of each
/// is certainly below the threshold. What is between the states is not looked at.
/// \param self  of a robot with the same joints, of which it may know more links
/// \throws InvalidRequest without a threshold, with one for the motion and errors of the robot, and
///         as RobotQuery::state() and planMotion()
CertifiedPlan planCertified(const RobotQuery& query, const SelfCollision& self,
                            const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                            const CertifiedPlanningRequest& request);

}  // namespace fcl_prob
