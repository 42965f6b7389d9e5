// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/call_budget.h"

#include <algorithm>

namespace fcl_prob::detail {
namespace {

/// A time limit has to be positive.
constexpr double kLeastSeconds = 1e-9;

/// An even share of what is left of a count, at least 1.
std::size_t evenShare(std::size_t limit, std::size_t used, std::size_t parts) {
  const std::size_t left = limit - std::min(limit, used);
  return std::max<std::size_t>(1, left / std::max<std::size_t>(1, parts));
}

}  // namespace

double CallBudget::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

std::optional<ProbabilityStatus> CallBudget::exhausted() const {
  if (request_.time_limit && seconds() >= *request_.time_limit) {
    return ProbabilityStatus::time_limit;
  }
  if (cells_ >= request_.max_cells) return ProbabilityStatus::cell_limit;
  return std::nullopt;
}

void CallBudget::shareTime(std::size_t parts, ProbabilityRequest& part) const {
  if (!request_.time_limit) return;
  const double left = *request_.time_limit - seconds();
  part.time_limit = std::max(kLeastSeconds, left / static_cast<double>(parts));
}

void CallBudget::share(std::size_t parts, ProbabilityRequest& part) const {
  shareTime(parts, part);
  part.max_cells = evenShare(request_.max_cells, cells_, parts);
  part.samples = evenShare(request_.samples, samples_, parts);
}

void CallBudget::spend(const ProbabilityStatistics& statistics) {
  cells_ += std::max(statistics.cells, statistics.raw_sum ? statistics.pairs_tested : 0);
  samples_ += statistics.samples;
}

ProbabilityRequest withTimeLeft(const ProbabilityRequest& request, const CallBudget& budget) {
  ProbabilityRequest result = request;
  budget.shareTime(1, result);
  return result;
}

}  // namespace fcl_prob::detail
