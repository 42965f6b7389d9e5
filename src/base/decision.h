// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What an answer says of what was asked.
#pragma once

#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob::detail {

/// On which side of request.threshold an interval that contains P lies; none if there is none.
inline Decision decisionOf(const Bounds& interval, const ProbabilityRequest& request) {
  if (!request.threshold) return Decision::none;
  if (interval.upper < *request.threshold) return Decision::below;
  if (interval.lower > *request.threshold) return Decision::above;
  return Decision::undecided;
}

/// Whether a threshold has been told from P.
inline bool isDecided(Decision decision) {
  return decision == Decision::below || decision == Decision::above;
}

/// Whether all that was asked for has been answered; else a limit was in the way.
inline bool isAnswered(ProbabilityStatus status) {
  return status == ProbabilityStatus::exact || status == ProbabilityStatus::converged ||
         status == ProbabilityStatus::decided;
}

}  // namespace fcl_prob::detail
