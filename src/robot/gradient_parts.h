// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Gradients that make one answer together, one after the other.
#pragma once

#include <cstddef>

#include "base/stopwatch.h"
#include "fcl_prob/motion_gradient.h"

namespace fcl_prob::detail {

/// Makes the progress of parts that of the whole, and shares its time among them: what one of them
/// does not use is there for the next. Its clock runs from when it is made.
class GradientParts {
 public:
  /// Keeps a reference.
  GradientParts(const MotionGradientRequest& whole, std::size_t count)
      : whole_(whole), count_(count) {}
  GradientParts(const GradientParts&) = delete;
  GradientParts& operator=(const GradientParts&) = delete;

  /// The request of part `index`; those before it are done. Its on_progress refers to this object.
  /// Once the whole is cancelled so is every part that is still to come, with the few lines that
  /// are drawn in any case: what it adds is known badly then, but with its error.
  MotionGradientRequest requestOf(std::size_t index);

 private:
  bool goOn(std::size_t index, ProbabilityProgress progress);

  const MotionGradientRequest& whole_;
  std::size_t count_;
  bool cancelled_ = false;
  Stopwatch watch_;
};

/// Of what has parts that ended in these two ways: what cut off one of them cut off the whole.
ProbabilityStatus statusOfBoth(ProbabilityStatus one, ProbabilityStatus other);

}  // namespace fcl_prob::detail
