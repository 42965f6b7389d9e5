// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The two radial functions whose integrals along edges give the mass of a polytope.
//
// Both are functions K(s) of s = r², and Laplace transforms of positive measures:
//   tail   k(s) = erfc(r/√2)/r = √(2/π) ∫₁^∞ exp(-s x²/2) dx   analytic for Re s > 0
//   core   E(s) = erf(r/√2)/r  = √(2/π) ∫₀¹ exp(-s x²/2) dx    entire
// Hence |K(s)| <= K(Re s), and |(K(s) - K(s₀))/(s - s₀)| <= -K'(min(Re s, s₀)) for complex s.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "gaussian/narrow_interval.h"
#include "gaussian/normal_density.h"

namespace fcl_prob::detail {

inline constexpr double kSqrtTwoOverPi = 0.79788456080286535588;

/// A value, and the sum of the magnitudes that it came from: rounding is a multiple of that.
struct Measured {
  double value;
  double magnitude;
};

/// Below this difference of the squares, the divided difference is computed by series.
inline constexpr double kCloseSquares = 0.2;

/// Φ-mass of [height, r] per length: the narrow mean about their middle; the difference of their
/// squares is at most kCloseSquares.
inline double meanDensityBetween(double height, double r, double difference) {
  const double sum = height + r;
  return sum > 0 ? narrowMean(0.5 * sum, 0.5 * difference / sum) : kInverseSqrtTwoPi;
}

struct TailKernel {
  /// erfc(r/√2)
  static double radial(double r) { return std::erfc(r * kInverseSqrtTwo); }

  static Measured divided(double at_r, double r, double at_height, double height,
                          double difference) {
    if (difference < kCloseSquares) {
      const double density = meanDensityBetween(height, r, difference);
      const double value = -(2 * height * density + at_height) / ((r + height) * r * height);
      return {value, -value};
    }
    const double first = at_r / r;
    const double second = at_height / height;
    return {(first - second) / difference, (first + second) / difference};
  }

  /// Bound on k(s), Re s = s_real > 0.
  static double bound(double s_real) { return kSqrtTwoOverPi * std::exp(-0.5 * s_real) / s_real; }

  /// Bound on -k'(s).
  static double derivativeBound(double s_real) {
    return kSqrtTwoOverPi * std::exp(-0.5 * s_real) * (1 + 1 / s_real) / (2 * s_real);
  }
};

struct CoreKernel {
  /// erf(r/√2)
  static double radial(double r) { return std::erf(r * kInverseSqrtTwo); }

  static Measured divided(double at_r, double r, double at_height, double height,
                          double difference) {
    const double second = height > 0 ? at_height / height : 2 * kInverseSqrtTwoPi;
    if (difference < kCloseSquares) {
      const double first = 2 * meanDensityBetween(height, r, difference);
      const double scale = 1 / ((r + height) * r);
      return {(first - second) * scale, (first + second) * scale};
    }
    const double first = at_r / r;
    return {(first - second) / difference, (first + second) / difference};
  }

  /// Bound on |E(s)|, any s_real.
  static double bound(double s_real) {
    return s_real <= 0 ? kSqrtTwoOverPi * std::exp(-0.5 * s_real)
                       : std::min(kSqrtTwoOverPi, 1 / std::sqrt(s_real));
  }

  /// Bound on -E'(s), any s_real.
  static double derivativeBound(double s_real) {
    constexpr double kAtZero = kSqrtTwoOverPi / 6;
    if (s_real <= 0) return kAtZero * std::exp(-0.5 * s_real);
    return std::min(kAtZero, 0.5 / (s_real * std::sqrt(s_real)));
  }
};

}  // namespace fcl_prob::detail
