// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How the probability of contact changes with the joints of a robot.
#pragma once

#include "fcl_prob/motion_gradient.h"

namespace fcl_prob {

/// P that a robot touches anything at any of some waypoints, and how it changes with the values of
/// its joints at each: estimates, see MotionGradient.
struct JointGradient {
  double probability = 0.0;
  double standard_error = 0.0;
  Eigen::MatrixXd gradient;  ///< ∂P: a row a joint (1/radian or 1/metre), a column a waypoint
  Eigen::MatrixXd gradient_standard_error;
  std::size_t lines = 0;  ///< of all obstacles

  /// `sampled`, `time_limit` or `cancelled`. Obstacles that are still to come when the query is
  /// cancelled have only the few lines that each has in any case.
  ProbabilityStatus status = ProbabilityStatus::sampled;
};

}  // namespace fcl_prob
