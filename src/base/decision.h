// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What an answer says of what was asked.
#pragma once

#include <algorithm>
#include <optional>

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

/// Whether nothing but a decision is asked for: there is a threshold. An estimate also ends at the
/// standard error that was asked for, since its interval need not become narrow.
inline bool asksForDecision(const ProbabilityRequest& request) {
  return request.threshold && request.method != ProbabilityMethod::estimate;
}

/// The one rule of what is enough: a threshold is satisfied by a decision and by nothing else, a
/// tolerance by a width. \return  `decided` or `converged`; nothing where more is to be done
inline std::optional<ProbabilityStatus> satisfied(const Bounds& interval,
                                                  const ProbabilityRequest& request) {
  if (isDecided(decisionOf(interval, request))) return ProbabilityStatus::decided;
  const bool is_narrow = interval.width() <= request.toleranceAt(interval.upper);
  if (asksForDecision(request) || !is_narrow) return std::nullopt;
  return ProbabilityStatus::converged;
}

/// By how much the interval has to become narrower, at least, before the request is satisfied.
inline double missingWidth(const Bounds& interval, const ProbabilityRequest& request) {
  const double too_wide = interval.width() - request.toleranceAt(interval.upper);
  if (!request.threshold) return too_wide;
  const double to_decide =
      std::min(interval.upper - *request.threshold, *request.threshold - interval.lower);
  return asksForDecision(request) ? to_decide : std::min(too_wide, to_decide);
}

/// Whether an interval that can become narrower by no more than `open` may still decide: its ends
/// have that far to go.
inline bool mayBeDecided(const Bounds& interval, double open, const ProbabilityRequest& request) {
  return isDecided(decisionOf({interval.lower + open, interval.upper}, request)) ||
         isDecided(decisionOf({interval.lower, interval.upper - open}, request));
}

}  // namespace fcl_prob::detail
