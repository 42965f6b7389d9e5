// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Sums of masses, with what rounding takes from them.
#pragma once

#include <algorithm>

#include "base/constants.h"
#include "fcl_prob/bounds.h"

namespace fcl_prob::detail {

/// Certified bounds of a mass whose own bounds were added up from about so many terms of one sign,
/// each sum rounded. What lies beyond kReach is below the smallest double, as what underflows is.
inline Bounds roundedSum(double lower, double upper, double terms) {
  const double rounding = 1.2e-16 * terms;
  return {std::clamp(lower * (1.0 - rounding) - kUnderflow, 0.0, 1.0),
          std::clamp(upper * (1.0 + rounding) + kUnderflow, 0.0, 1.0)};
}

/// No less than the sum of two numbers that are not negative, which doubles round by 1.2e-16 of it.
inline double sumAbove(double a, double b) { return (a + b) * (1.0 + 1e-15); }

}  // namespace fcl_prob::detail
