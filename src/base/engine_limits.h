// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The clock and the caller's wishes, as engines that divide cells look at them.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>

#include "fcl_prob/bounds.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob::detail {

/// Time counts from its construction on.
class EngineLimits {
 public:
  /// The share of the time limit that an estimate may divide cells for; what remains is for
  /// sampling them.
  static constexpr double kShareForDividing = 0.8;

  /// Between two looks at them.
  static constexpr std::size_t kCellsBetweenPolls = 16;

  /// Keeps references to both.
  EngineLimits(const ProbabilityRequest& request, const ProbabilityStatistics& statistics)
      : request_(request), statistics_(statistics), started_(std::chrono::steady_clock::now()) {}

  /// Whether so much of the time is up, or the caller cancels. \param now  the interval so far
  std::optional<ProbabilityStatus> interruption(const Bounds& now, double share = 1.0) const {
    if (request_.time_limit && secondsSoFar() >= share * *request_.time_limit) {
      return ProbabilityStatus::time_limit;
    }
    if (isCancelled(now)) return ProbabilityStatus::cancelled;
    return std::nullopt;
  }

 private:
  double secondsSoFar() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  }

  bool isCancelled(const Bounds& now) const {
    if (!request_.on_progress) return false;
    ProbabilityProgress progress;
    progress.interval = now;
    progress.fraction =
        static_cast<double>(statistics_.cells) / static_cast<double>(request_.max_cells);
    progress.seconds = secondsSoFar();
    return !request_.on_progress(progress);
  }

  const ProbabilityRequest& request_;
  const ProbabilityStatistics& statistics_;
  std::chrono::steady_clock::time_point started_;
};

/// What one of several that divide cells has done, added to what all have.
inline void addWork(const ProbabilityStatistics& of_one, ProbabilityStatistics& of_all) {
  of_all.cells += of_one.cells;
  of_all.pairs_tested += of_one.pairs_tested;
  of_all.peak_front = std::max(of_all.peak_front, of_one.peak_front);
}

}  // namespace fcl_prob::detail
