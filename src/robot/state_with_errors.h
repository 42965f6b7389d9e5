// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// States of a robot whose joints and base have errors of their own.
#pragma once

#include "robot/robot_among_obstacles.h"

namespace fcl_prob::detail {

/// The covariance of all joints. \throws as RobotQuery::state() with errors, but for contact that
/// is allowed with some obstacles only
Eigen::MatrixXd validCovariance(const RobotAmongObstacles& among, const RobotErrors& errors);

/// In any of the states, all errors being the same in each.
/// \throws as RobotQuery::motion() with errors
ProbabilityResult statesWithErrors(const RobotAmongObstacles& among,
                                   const std::vector<Eigen::VectorXd>& states,
                                   const RobotErrors& errors, const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
