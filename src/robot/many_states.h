// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// One question of many states, on several threads.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "fcl_prob/probability_request.h"
#include "fcl_prob/probable_decision.h"

namespace fcl_prob::detail {

/// \throws InvalidRequest unless it is above 0 and below 1
void requireChance(double chance_of_error);

using StateDecision =
    std::function<ProbableDecision(const Eigen::VectorXd& values, const ProbabilityRequest&)>;

/// By column. The time limit is that of all; states that are not reached are undecided.
/// \param decide  called by several threads
std::vector<ProbableDecision> manyStates(const Eigen::MatrixXd& states,
                                         const ProbabilityRequest& request,
                                         const StateDecision& decide);

}  // namespace fcl_prob::detail
