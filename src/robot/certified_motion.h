// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A motion with persistent errors, and a certificate for each obstacle.
#pragma once

#include <iosfwd>
#include <vector>

#include "robot/robot_among_obstacles.h"

namespace fcl_prob::detail {

/// See RobotQuery::certified().
RobotResult certifiedMotion(const RobotAmongObstacles& among,
                            const std::vector<Eigen::VectorXd>& waypoints,
                            const ProbabilityRequest& request, std::ostream& certificate);

}  // namespace fcl_prob::detail
