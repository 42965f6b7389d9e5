// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The standard normal density to a few ulp, also far out.
#pragma once

#include <cmath>

namespace fcl_prob::detail {

inline constexpr double kInverseSqrtTwoPi = 0.39894228040143267794;
inline constexpr double kInverseSqrtTwo = 0.70710678118654752440;

/// exp(-(h + h_low)²/2), with |h_low| at most an ulp of h. Rounding of h² alone would cost a
/// relative error of h² eps, 3e-13 at h = 38; so the square is split into an exact part and a small
/// remainder.
inline double gaussianExp(double h, double h_low = 0.0) {
  if (!(std::abs(h) < 40)) return std::exp(-0.5 * h * h);  // 0 (or NaN)
  const double coarse = static_cast<double>(static_cast<float>(h));
  const double fine = (h - coarse) + h_low;
  const double s = -0.5 * fine * ((h + h_low) + coarse);  // below 1e-4: four terms are enough
  return std::exp(-0.5 * coarse * coarse) * (1 + s * (1 + s * (1.0 / 2 + s * (1.0 / 6))));
}

inline double normalDensity(double h) { return kInverseSqrtTwoPi * gaussianExp(h); }

}  // namespace fcl_prob::detail
