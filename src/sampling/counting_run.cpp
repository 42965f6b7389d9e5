// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "sampling/counting_run.h"

#include <cmath>

#include "fcl_prob/monte_carlo.h"

namespace fcl_prob::detail {

CountingRun::CountingRun(const ProbabilityRequest& request)
    : SamplingRun(request, request.samples, request.absolute_tolerance), collided_(kSlots) {}

ProbabilityResult CountingRun::result(Budget& budget) {
  ProbabilityResult result = run(budget);
  result.method = ProbabilityMethod::monte_carlo;
  const auto n = static_cast<double>(counted());
  const auto hits = static_cast<double>(hits_);
  const double smoothed = (hits + 0.5) / (n + 1.0);
  result.estimate = hits / n;
  result.standard_error = std::sqrt(smoothed * (1.0 - smoothed) / n);
  result.statistics.hits = hits_;
  result.statistics.seconds.emplace_back("sampling", budget.seconds());
  return result;
}

void CountingRun::count(std::size_t index, std::size_t slot) {
  if (!collided_[slot]) return;
  ++hits_;
  countHit(index);
}

Bounds CountingRun::interval(double confidence) const {
  return clopperPearsonInterval(hits_, counted(), confidence);
}

}  // namespace fcl_prob::detail
