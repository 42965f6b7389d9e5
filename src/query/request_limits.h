// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The time limit and the cancellation of a request, for what runs in one piece.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "base/interruption.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob::detail {

/// The clock starts when this is made.
class RequestLimits {
 public:
  /// \param share  of the time limit
  explicit RequestLimits(const ProbabilityRequest& request, double share = 1.0)
      : request_(request), share_(share) {}

  /// Looks at the limits at every 64th call. What is done in fewer is never interrupted.
  /// Refers to this object.
  Interruption interruption() {
    return [this] { return poll(); };
  }

  /// `time_limit` or `cancelled`, once that has happened.
  std::optional<ProbabilityStatus> reason() const { return reason_; }

  /// What on_progress is told.
  void setProgress(const Bounds& interval, double fraction) {
    interval_ = interval;
    fraction_ = fraction;
  }

 private:
  bool poll();

  const ProbabilityRequest& request_;
  double share_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::size_t polls_ = 0;
  Bounds interval_{0.0, 1.0};
  double fraction_ = 0.0;
  std::optional<ProbabilityStatus> reason_;
};

}  // namespace fcl_prob::detail
