// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Decisions that are right but for a stated chance.
#pragma once

#include <cstddef>
#include <string>

#include "fcl_prob/bounds.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob {

/// On which side of a threshold P is, and how that is known.
enum class ProbableDecision {
  undecided,
  certainly_below,  ///< certified
  certainly_above,  ///< certified
  probably_below,   ///< but for ProbableResult::chance_of_error
  probably_above    ///< but for ProbableResult::chance_of_error
};

/// What is certified and what is probable, side by side and never one for the other.
struct ProbableResult {
  ProbableDecision decision = ProbableDecision::undecided;

  /// Of being wrong with this decision, whatever P is: 0 for a certain one.
  double chance_of_error = 0.0;

  /// Certified, rounding included.
  Bounds certified{0.0, 1.0};

  /// Within `certified`: holds but for the chance that was stated. That is the chance that it ever
  /// fails to, at any of the moments at which it was looked at, and so where it was looked at the
  /// last time because it decided.
  Bounds probable{0.0, 1.0};

  /// `decided`, or why it could not be.
  ProbabilityStatus status = ProbabilityStatus::converged;

  std::size_t cells = 0;    ///< of the partitions
  std::size_t samples = 0;  ///< none for a certain decision that needed none
};

std::string toString(ProbableDecision decision);

}  // namespace fcl_prob
