// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How often something happens, as told by samples at every moment.
#pragma once

#include <cstddef>

#include "fcl_prob/bounds.h"

namespace fcl_prob::detail {

/// A confidence sequence for the probability p of a hit, from independent samples.
///
/// The likelihood of h hits in n samples under p, against its mean over Jeffreys' prior, exceeds
/// 1/error at any n whatsoever with a chance of at most `error` (Ville 1939; the mixture is a
/// martingale). The set of all p for which it has not done so is an interval around h / n: it holds
/// at every moment at once, so that one may look as often as one likes and stop when one likes.
class HitSequence {
 public:
  void add(std::size_t hits, std::size_t samples) {
    hits_ += hits;
    samples_ += samples;
  }

  std::size_t samples() const { return samples_; }

  /// \param error  chance that it ever fails, in (0, 1)
  Bounds interval(double error) const;

 private:
  std::size_t hits_ = 0;
  std::size_t samples_ = 0;
};

}  // namespace fcl_prob::detail
