// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// One question of many states, on several threads.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "fcl_prob/probable_decision.h"
#include "fcl_prob/robot_query.h"

namespace fcl_prob::detail {

/// \throws InvalidRequest unless it is above 0 and below 1
void requireChance(double chance_of_error);

/// A certified decision.
ProbableDecision certain(Decision decision);

using StateDecision =
    std::function<ProbableDecision(const Eigen::VectorXd& values, const ProbabilityRequest&)>;

/// The joints that have not the same value in all states, a column each.
std::vector<Eigen::Index> movingRows(const Eigen::MatrixXd& states);

/// By column. The time limit is that of all; states that are not reached are undecided.
/// \param decide  called by several threads
std::vector<ProbableDecision> manyStates(const Eigen::MatrixXd& states,
                                         const ProbabilityRequest& request,
                                         const StateDecision& decide);

/// As RobotQuery::decideStates(), which has validated all but the errors. \param errors  some
std::vector<ProbableDecision> decideWithErrors(const RobotQuery& query,
                                               const Eigen::MatrixXd& states,
                                               const RobotErrors& errors,
                                               const ProbabilityRequest& request,
                                               std::optional<double> chance_of_error);

}  // namespace fcl_prob::detail
