// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A first path, by OMPL's RRT-Connect.
#pragma once

#include <vector>

#include "planning/joint_space.h"
#include "planning/planning_run.h"

namespace fcl_prob::detail {

/// From start to one of several goals; empty if a limit ended the search.
std::vector<Eigen::VectorXd> connected(const JointSpace& space, PlanningRun& run,
                                       const Eigen::VectorXd& start,
                                       const std::vector<Eigen::VectorXd>& goals);

}  // namespace fcl_prob::detail
