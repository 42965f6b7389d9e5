// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A path made shorter, as far as the test of states allows.
#pragma once

#include "planning/planning_run.h"

namespace fcl_prob::detail {

/// Each is never longer than what it is given, and every edge of it has been asked for as a whole.
/// (OMPL's short cuts leave the remainders of cut edges unasked, with other states between their
/// ends than the edge had.)

/// Straight lines between two points of the path, drawn at random by the seed.
std::vector<Eigen::VectorXd> cutShort(std::vector<Eigen::VectorXd> waypoints, PlanningRun& run);

/// Waypoints pulled towards the line between their neighbours, all joints together or one of them,
/// as an elastic band would; more of them than there were, so that the path can bend around what is
/// in its way.
std::vector<Eigen::VectorXd> pulledTaut(std::vector<Eigen::VectorXd> waypoints, PlanningRun& run);

/// Both, the run being told that a path is there.
std::vector<Eigen::VectorXd> shortened(std::vector<Eigen::VectorXd> waypoints, PlanningRun& run);

}  // namespace fcl_prob::detail
