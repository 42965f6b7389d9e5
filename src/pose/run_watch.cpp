// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/run_watch.h"

#include <algorithm>

namespace fcl_prob::detail {

bool RunWatch::goOn() const {
  if (cancelled_ || timed_out_) return false;
  const double now = seconds();
  if (request_.time_limit && now >= *request_.time_limit) {
    timed_out_ = true;
    return false;
  }
  if (request_.on_progress && std::this_thread::get_id() == caller_) {
    const double by_cells = static_cast<double>(cells_) /
                            static_cast<double>(std::max<std::size_t>(request_.max_cells, 1));
    const double by_time = request_.time_limit ? now / *request_.time_limit : 0.0;
    const double fraction = std::min(1.0, std::max(by_cells, by_time));
    if (!request_.on_progress({interval_, fraction, now})) cancelled_ = true;
  }
  return !cancelled_;
}

std::optional<ProbabilityStatus> RunWatch::reason() const {
  if (cancelled_) return ProbabilityStatus::cancelled;
  if (timed_out_) return ProbabilityStatus::time_limit;
  if (cells_ >= request_.max_cells) return ProbabilityStatus::cell_limit;
  return std::nullopt;
}

}  // namespace fcl_prob::detail
