// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "base/budget.h"

#include <algorithm>
#include <limits>

namespace fcl_prob::detail {
namespace {

/// A call comes every few microseconds, and on_progress may take as long as it likes.
constexpr std::size_t kPollEvery = 64;

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

void Budget::spend(const ProbabilityStatistics& statistics) {
  cells_ += std::max(statistics.cells, statistics.raw_sum ? statistics.pairs_tested : 0);
  samples_ += statistics.samples;
}

void Budget::tell(const Bounds& interval, double fraction) {
  interval_ = interval;
  fraction_ = fraction;
}

ProbabilityProgress Budget::progress(double now) const {
  const double by_cells = static_cast<double>(cells_) /
                          static_cast<double>(std::max<std::size_t>(request_.max_cells, 1));
  const double by_time = request_.time_limit ? now / *request_.time_limit : 0.0;
  return {interval_, std::min(1.0, std::max({fraction_, by_cells, by_time})), now};
}

std::optional<ProbabilityStatus> Budget::look(double share) const {
  if (const auto reason = stopped()) return reason;
  const double now = seconds();
  if (request_.time_limit && now >= share_ * share * *request_.time_limit) {
    if (share == 1.0) timed_out_ = true;
    return ProbabilityStatus::time_limit;
  }
  if (request_.on_progress && std::this_thread::get_id() == caller_ &&
      !request_.on_progress(progress(now))) {
    cancelled_ = true;
  }
  return stopped();
}

std::optional<ProbabilityStatus> Budget::look(const Bounds& interval, double fraction,
                                              double share) {
  tell(interval, fraction);
  return look(share);
}

Interruption Budget::interruption() {
  return [this] { return stopped() || (++polls_ % kPollEvery == 0 && !goOn()); };
}

std::optional<ProbabilityStatus> Budget::stopped() const {
  if (cancelled_) return ProbabilityStatus::cancelled;
  if (timed_out_) return ProbabilityStatus::time_limit;
  return std::nullopt;
}

std::optional<ProbabilityStatus> Budget::exhausted() const {
  if (const auto reason = stopped()) return reason;
  if (request_.time_limit && seconds() >= *request_.time_limit) {
    return ProbabilityStatus::time_limit;
  }
  if (cells_ >= request_.max_cells) return ProbabilityStatus::cell_limit;
  return std::nullopt;
}

Allowance Budget::left() const {
  const double time = request_.time_limit.value_or(std::numeric_limits<double>::infinity());
  return {std::max(0.0, time - seconds()), without(request_.max_cells, cells_),
          without(request_.samples, samples_)};
}

void Budget::shareTime(std::size_t parts, ProbabilityRequest& part, double kept_back) const {
  if (!request_.time_limit) return;
  const double seconds = left().seconds - kept_back;
  part.time_limit = std::max(kLeastSeconds, seconds / static_cast<double>(parts));
}

void Budget::share(std::size_t parts, ProbabilityRequest& part, const Allowance& kept_back) const {
  const Allowance all = left();
  shareTime(parts, part, kept_back.seconds);
  part.max_cells = evenShare(without(all.cells, kept_back.cells), parts);
  part.samples = evenShare(without(all.samples, kept_back.samples), parts);
}

ProbabilityRequest Budget::withTimeLeft() const {
  ProbabilityRequest result = request_;
  shareTime(1, result);
  return result;
}

}  // namespace fcl_prob::detail
