// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// When an estimate is to leave off: limits and cancellation, seen from all of its threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <optional>
#include <thread>

#include "base/stopwatch.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"
#include "montecarlo/sample_loop.h"

namespace fcl_prob::detail {

class RunWatch {
 public:
  /// Keeps a reference. Made by the thread that made the query.
  explicit RunWatch(const ProbabilityRequest& request) : request_(request) {}

  /// False from when the query is out of time or cancelled on. Any thread may ask; only the one
  /// that made the query calls on_progress.
  bool goOn() const;

  /// `time_limit`, `cancelled` or `cell_limit`, once that has happened.
  std::optional<ProbabilityStatus> reason() const;

  /// Work that counts against the limit on cells; not while others ask.
  void addCells(std::size_t count) { cells_ += count; }

  /// What on_progress is told; not while others ask.
  void setProgress(const Bounds& interval) { interval_ = interval; }

  double seconds() const { return watch_.seconds(); }

 private:
  const ProbabilityRequest& request_;
  Bounds interval_{0.0, 1.0};
  std::size_t cells_ = 0;
  std::thread::id caller_ = std::this_thread::get_id();
  mutable std::atomic<bool> cancelled_{false};
  mutable std::atomic<bool> timed_out_{false};
  Stopwatch watch_;
};

}  // namespace fcl_prob::detail
