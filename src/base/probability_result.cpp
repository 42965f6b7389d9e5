// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/probability_result.h"

#include <limits>

#include "fcl_prob/exceptions.h"

namespace fcl_prob {

double ProbabilityResult::probability() const {
  if (estimate) return *estimate;
  if (lower && upper) return 0.5 * (*lower + *upper);
  if (upper) return *upper;
  return std::numeric_limits<double>::quiet_NaN();
}

std::string toString(Decision decision) {
  switch (decision) {
    case Decision::none:
      return "none";
    case Decision::below:
      return "below";
    case Decision::above:
      return "above";
    case Decision::undecided:
      return "undecided";
  }
  throw InvalidRequest("not a Decision: " + std::to_string(static_cast<int>(decision)));
}

std::string toString(ProbabilityStatus status) {
  switch (status) {
    case ProbabilityStatus::converged:
      return "converged";
    case ProbabilityStatus::exact:
      return "exact";
    case ProbabilityStatus::decided:
      return "decided";
    case ProbabilityStatus::bound_only:
      return "bound-only";
    case ProbabilityStatus::sampled:
      return "sampled";
    case ProbabilityStatus::time_limit:
      return "time-limit";
    case ProbabilityStatus::cell_limit:
      return "cell-limit";
    case ProbabilityStatus::memory_limit:
      return "memory-limit";
    case ProbabilityStatus::resolution_limit:
      return "resolution-limit";
    case ProbabilityStatus::cancelled:
      return "cancelled";
    case ProbabilityStatus::band_limit:
      return "band-limit";
  }
  throw InvalidRequest("not a ProbabilityStatus: " + std::to_string(static_cast<int>(status)));
}

}  // namespace fcl_prob
