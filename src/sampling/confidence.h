// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Confidence intervals of sampled probabilities.
#pragma once

#include <cstddef>
#include <vector>

#include "fcl_prob/bounds.h"

namespace fcl_prob::detail {

/// When a sampling run looks at its interval to decide whether it may stop, and with what
/// confidence: the error probabilities of all looks add up to that of the whole (union bound), most
/// of it being kept for the last one.
class LookSchedule {
 public:
  LookSchedule(std::size_t samples, double confidence);

  /// The first look after `done` samples; the last one is at the number of samples asked for.
  std::size_t next(std::size_t done) const;

  /// The confidence of the interval taken at look `samples`.
  double confidenceAt(std::size_t samples) const;

  /// The confidence of the last look, which is also that of a run stopped from outside.
  double finalConfidence() const;

 private:
  std::vector<std::size_t> looks_;
  double error_;
};

/// Sums over the hits of importance sampling; misses have weight 0.
struct WeightedHits {
  std::size_t hits = 0;
  double sum = 0.0;          ///< of the weights
  double sum_squares = 0.0;  ///< of the squared weights

  void add(double weight) {
    ++hits;
    sum += weight;
    sum_squares += weight * weight;
  }
};

/// Confidence interval of a sum of weights, each at most `largest_weight` (Fay & Feuer 1997, gamma
/// intervals of weighted Poisson counts); exact for equal weights, conservative for others. The
/// square of the largest weight must not underflow; those of others may.
Bounds gammaInterval(const WeightedHits& hits, double largest_weight, double confidence);

}  // namespace fcl_prob::detail
