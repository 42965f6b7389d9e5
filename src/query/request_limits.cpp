// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/request_limits.h"

#include <algorithm>

namespace fcl_prob::detail {
namespace {

/// A call comes every few microseconds, and on_progress may take as long as it likes.
constexpr std::size_t kPollEvery = 64;

}  // namespace

bool RequestLimits::poll() {
  if (reason_) return true;
  if (++polls_ % kPollEvery != 0) return false;
  ProbabilityProgress progress{interval_, fraction_, 0.0};
  progress.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (request_.time_limit) {
    progress.fraction = std::clamp(progress.seconds / *request_.time_limit, progress.fraction, 1.0);
    if (progress.seconds >= share_ * *request_.time_limit) reason_ = ProbabilityStatus::time_limit;
  }
  if (!reason_ && request_.on_progress && !request_.on_progress(progress)) {
    reason_ = ProbabilityStatus::cancelled;
  }
  return reason_.has_value();
}

}  // namespace fcl_prob::detail
