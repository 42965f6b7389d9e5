// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What is told of a robot with every answer, and what is asked of every state.
#pragma once

#include <string>
#include <vector>

#include "fcl_prob/robot.h"

namespace fcl_prob::detail {

/// Robot::notes(), and its links without a body in one sentence, if there are any.
std::vector<std::string> robotNotes(const Robot& robot);

/// Of several waypoints the message says which one. \throws as Robot::requireWithinLimits()
void requireWithinLimits(const Robot& robot, const std::vector<Eigen::VectorXd>& waypoints);

}  // namespace fcl_prob::detail
