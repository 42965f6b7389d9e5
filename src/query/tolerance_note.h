// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Which of the two tolerances an answer has reached.
#pragma once

#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob::detail {

/// Says so in the plan where an answer has converged by the absolute tolerance only: its interval,
/// or its standard error, may then be as large as P itself.
void noteTolerance(const ProbabilityRequest& request, ProbabilityResult& result);

}  // namespace fcl_prob::detail
