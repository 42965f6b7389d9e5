// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Many states of a robot that is known up to errors of its joints and base.
#pragma once

#include <optional>
#include <vector>

#include "fcl_prob/robot_query.h"

namespace fcl_prob::detail {

/// As RobotQuery::decideStates(), which has validated all but the errors. \param errors  some
std::vector<ProbableDecision> decideWithErrors(const RobotQuery& query,
                                               const Eigen::MatrixXd& states,
                                               const RobotErrors& errors,
                                               const ProbabilityRequest& request,
                                               std::optional<double> chance_of_error);

}  // namespace fcl_prob::detail
