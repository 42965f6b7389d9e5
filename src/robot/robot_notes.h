// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What is told of a robot and its obstacles with every answer, and what is asked of every state.
#pragma once

#include <string>
#include <vector>

#include "fcl_prob/robot_query.h"

namespace fcl_prob::detail {

/// Robot::notes() and those of the obstacles, and links without a body in one sentence, if there
/// are any.
std::vector<std::string> standingNotes(const Robot& robot, const std::vector<Obstacle>& obstacles);

/// Meshes that were read in single precision, where what that rounds is not small beside the
/// displacements or the tolerance.
std::vector<std::string> precisionNotes(const Robot& robot, const std::vector<Obstacle>& obstacles,
                                        double tolerance);

/// Both, for where no RobotResult tells them.
std::vector<std::string> allNotes(const RobotQuery& query, double tolerance);

/// Of several waypoints the message says which one. \throws as Robot::requireWithinLimits()
void requireWithinLimits(const Robot& robot, const std::vector<Eigen::VectorXd>& waypoints);

}  // namespace fcl_prob::detail
