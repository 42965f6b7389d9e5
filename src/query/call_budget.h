// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The limits of a call that is made of several queries or stages: they are those of the whole.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

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

/// What is left of the limits of a request. The clock starts when this is made.
class CallBudget {
 public:
  explicit CallBudget(const ProbabilityRequest& request) : request_(request) {}

  double seconds() const;

  Allowance left() const;

  /// `time_limit` or `cell_limit` once nothing is left.
  std::optional<ProbabilityStatus> exhausted() const;

  /// Narrows the time limit of `part`, a request for the first of `parts` that are left to be done,
  /// to an even share: what one of them does not use is there for the next.
  void shareTime(std::size_t parts, ProbabilityRequest& part) const;

  /// The same for the time limit, the cells and the samples, of which each part has at least one.
  /// Memory is given back after each part, so that each may have all of it.
  /// \param kept_back  what the parts leave for later
  void share(std::size_t parts, ProbabilityRequest& part, const Allowance& kept_back = {}) const;

  void spend(const ProbabilityStatistics& statistics);

 private:
  const ProbabilityRequest& request_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::size_t cells_ = 0;
  std::size_t samples_ = 0;
};

/// The request with what `budget` leaves of its time.
ProbabilityRequest withTimeLeft(const ProbabilityRequest& request, const CallBudget& budget);

}  // namespace fcl_prob::detail
