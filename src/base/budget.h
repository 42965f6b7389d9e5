// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The limits of one call: its clock, its cells and samples, its caller's wish to go on.
#pragma once

#include <atomic>
#include <cstddef>
#include <optional>
#include <thread>

#include "base/interruption.h"
#include "base/stopwatch.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob::detail {

/// How much of the limits of a request: of its time, its cells (general_pcd: pairs), its samples.
struct Allowance {
  double seconds = 0.0;  ///< infinite without a time limit
  std::size_t cells = 0;
  std::size_t samples = 0;

  /// This part of it, from 0 to 1.
  Allowance part(double of_it) const;
};

/// What the limits of a request leave, and the only place that looks at them. A part of a call
/// borrows a share, as a request of its own (share()), and tells what it spent: the rest is there
/// for its siblings. The clock starts when this is made, by the thread that made the call.
class Budget {
 public:
  /// Keeps a reference.
  /// \param share  of the time limit
  explicit Budget(const ProbabilityRequest& request, double share = 1.0)
      : request_(request), share_(share) {}
  Budget(const Budget&) = delete;
  Budget& operator=(const Budget&) = delete;

  double seconds() const { return clock_.seconds(); }

  /// Work that is done.
  void spend(const ProbabilityStatistics& statistics);
  void spendCells(std::size_t cells) { cells_ += cells; }

  /// What on_progress is told; not while other threads ask.
  /// \param fraction  of the work; time and cells that are spent may say more
  void tell(const Bounds& interval, double fraction = 0.0);

  /// False from when the time is up or the caller cancels on. Any thread may ask; only the one that
  /// made this calls on_progress.
  bool goOn() const { return !look(); }

  /// Why not; now, and for an earlier end of the time limit.
  std::optional<ProbabilityStatus> look(double share = 1.0) const;

  /// tell() and look() at once.
  std::optional<ProbabilityStatus> look(const Bounds& interval, double fraction,
                                        double share = 1.0);

  /// Looks at every 64th call: what is done in fewer is never interrupted. Refers to this object.
  Interruption interruption();

  /// `time_limit` or `cancelled`, once that was seen.
  std::optional<ProbabilityStatus> stopped() const;

  /// The same, and `time_limit` or `cell_limit` once nothing is left.
  std::optional<ProbabilityStatus> exhausted() const;

  Allowance left() const;

  /// Narrows the time limit of `part`, a request for the first of `parts` that are left to be done,
  /// to an even share: what one of them does not use is there for the next.
  /// \param kept_back  seconds that the parts leave for later
  void shareTime(std::size_t parts, ProbabilityRequest& part, double kept_back = 0.0) const;

  /// The same for the time limit, the cells and the samples, of which each part has at least one.
  /// Memory is given back after each part, so that each may have all of it.
  /// \param kept_back  what the parts leave for later
  void share(std::size_t parts, ProbabilityRequest& part, const Allowance& kept_back = {}) const;

  /// The request with what is left of its time.
  ProbabilityRequest withTimeLeft() const;

 private:
  ProbabilityProgress progress(double now) const;

  const ProbabilityRequest& request_;
  double share_;
  Stopwatch clock_;
  std::size_t cells_ = 0;
  std::size_t samples_ = 0;
  std::size_t polls_ = 0;
  Bounds interval_{0.0, 1.0};
  double fraction_ = 0.0;
  std::thread::id caller_ = std::this_thread::get_id();
  mutable std::atomic<bool> cancelled_{false};
  mutable std::atomic<bool> timed_out_{false};
};

}  // namespace fcl_prob::detail
