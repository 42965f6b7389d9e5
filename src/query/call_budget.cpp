// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/call_budget.h"

#include <algorithm>
#include <limits>

namespace fcl_prob::detail {
namespace {

/// A time limit has to be positive.
constexpr double kLeastSeconds = 1e-9;

/// What is left of a count when so many of it are gone.
std::size_t without(std::size_t count, std::size_t gone) { return count - std::min(count, gone); }

/// An even share of a count, at least 1.
std::size_t evenShare(std::size_t left, std::size_t parts) {
  return std::max<std::size_t>(1, left / std::max<std::size_t>(1, parts));
}

std::size_t partOf(std::size_t count, double part) {
  return static_cast<std::size_t>(part * static_cast<double>(count));
}

}  // namespace

Allowance Allowance::part(double of_it) const {
  if (!(of_it > 0.0)) return {};
  return {of_it * seconds, partOf(cells, of_it), partOf(samples, of_it)};
}

Allowance CallBudget::left() const {
  const double time = request_.time_limit.value_or(std::numeric_limits<double>::infinity());
  return {std::max(0.0, time - seconds()), without(request_.max_cells, cells_),
          without(request_.samples, samples_)};
}

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
  part.time_limit = std::max(kLeastSeconds, left().seconds / static_cast<double>(parts));
}

void CallBudget::share(std::size_t parts, ProbabilityRequest& part,
                       const Allowance& kept_back) const {
  const Allowance all = left();
  if (request_.time_limit) {
    const double seconds = all.seconds - kept_back.seconds;
    part.time_limit = std::max(kLeastSeconds, seconds / static_cast<double>(parts));
  }
  part.max_cells = evenShare(without(all.cells, kept_back.cells), parts);
  part.samples = evenShare(without(all.samples, kept_back.samples), parts);
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
