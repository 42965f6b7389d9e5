// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/tolerance_note.h"

#include "base/number_text.h"

namespace fcl_prob::detail {

void noteTolerance(const ProbabilityRequest& request, ProbabilityResult& result) {
  if (result.status != ProbabilityStatus::converged) return;
  double width = 0.0, allowed = 0.0;
  std::string what = "interval";
  if (result.confidence_interval) {
    width = 0.5 * result.confidence_interval->width();
    allowed = request.relative_tolerance * result.confidence_interval->upper;
  } else if (request.method == ProbabilityMethod::estimate && result.estimate) {
    what = "standard error";
    width = result.standard_error.value_or(0.0);
    allowed = request.relative_tolerance * *result.estimate;
  } else if (result.lower && result.upper) {
    width = *result.upper - *result.lower;
    allowed = request.relative_tolerance * *result.upper;
  }
  if (!(width > allowed)) return;
  result.plan.push_back(
      "stopped at the absolute tolerance " + numberText(request.absolute_tolerance) + ": the " +
      what + " is wider than the relative tolerance " + numberText(request.relative_tolerance) +
      " allows; make the absolute one smaller for a rare event");
}

}  // namespace fcl_prob::detail
