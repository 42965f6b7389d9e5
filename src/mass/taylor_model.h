// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Arithmetic of first-order Taylor models (Makino and Berz 2003), by which functions of two complex
// parameters are bounded around real boxes.
#pragma once

#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {

/// middle + first σ + second τ and all within `radius` of that, for complex |σ| <= 1, |τ| <= 1.
/// What operations make of models contains what they make of the functions, rounding included;
/// where nothing is known the radius is not finite.
struct TaylorModel {
  TaylorModel() = default;
  TaylorModel(double value) : middle(value) {}  // NOLINT(google-explicit-constructor)
  TaylorModel(double value, double along_first, double along_second, double rest)
      : middle(value), first(along_first), second(along_second), radius(rest) {}

  /// How far values are from the middle at the most, and what is left of that beyond `first`, when
  /// averaged over a segment that begins at the middle.
  double spread() const { return std::abs(first) + std::abs(second) + radius; }
  double meanSpread() const { return 0.5 * (std::abs(first) + std::abs(second)) + radius; }

  double most() const { return std::abs(middle) + spread(); }

  double middle = 0.0, first = 0.0, second = 0.0, radius = 0.0;
};

inline TaylorModel operator+(const TaylorModel& a, const TaylorModel& b) {
  const double rounding = 2.0 * kEpsilon * (a.most() + b.most());
  return {a.middle + b.middle, a.first + b.first, a.second + b.second,
          a.radius + b.radius + rounding};
}

inline TaylorModel operator-(const TaylorModel& a, const TaylorModel& b) {
  const double rounding = 2.0 * kEpsilon * (a.most() + b.most());
  return {a.middle - b.middle, a.first - b.first, a.second - b.second,
          a.radius + b.radius + rounding};
}

inline TaylorModel operator*(double a, const TaylorModel& b) {
  return {a * b.middle, a * b.first, a * b.second,
          std::abs(a) * (b.radius + 4.0 * kEpsilon * b.most())};
}

inline TaylorModel operator*(const TaylorModel& a, const TaylorModel& b) {
  const double slope_a = std::abs(a.first) + std::abs(a.second);
  const double slope_b = std::abs(b.first) + std::abs(b.second);
  const double most_a = std::abs(a.middle) + slope_a, most_b = std::abs(b.middle) + slope_b;
  const double radius = slope_a * slope_b + most_a * b.radius + a.radius * (most_b + b.radius) +
                        8.0 * kEpsilon * (most_a + a.radius) * (most_b + b.radius);
  return {a.middle * b.middle, a.middle * b.first + a.first * b.middle,
          a.middle * b.second + a.second * b.middle, radius};
}

/// f(z) about the middle m of z: value f(m), slope f'(m), and a bound on what is left.
inline TaylorModel composed(const TaylorModel& z, double value, double slope, double rest) {
  const double rounding = 16.0 * kEpsilon * (std::abs(value) + std::abs(slope) * z.spread());
  return {value, slope * z.first, slope * z.second,
          std::abs(slope) * z.radius + rest * (1.0 + 1e-12) + rounding};
}

/// √(1 - x) for the largest share x of its middle that z is off it; 0 if that may be all.
inline double leastRoot(const TaylorModel& z) {
  const double share = z.spread() * (1.0 + 1e-12) / z.middle;
  return share >= 0.0 && share < 1.0 ? std::sqrt(1.0 - share) : 0.0;
}

/// (1 - r)² for r = √(1 - x), without cancellation.
inline double squareOfFall(const TaylorModel& z, double root) {
  const double fall = z.spread() * (1.0 + 1e-12) / z.middle / (1.0 + root);
  return fall * fall;
}

/// The terms of √(1 + u) behind the first two are no more than those of 1 - x/2 - √(1 - x), which
/// is (1 - r)²/2, for |u| <= x.
inline TaylorModel squareRoot(const TaylorModel& z) {
  const double least = leastRoot(z);
  if (!(least > 0.0)) return {0.0, 0.0, 0.0, kInfinity};
  const double root = std::sqrt(z.middle);
  return composed(z, root, 0.5 / root, 0.5 * root * squareOfFall(z, least));
}

/// Those of 1/√(1 + u) are no more than 1/√(1 - x) - 1 - x/2 = (1 - r)² (2 + r) / (2 r).
inline TaylorModel inverseSquareRoot(const TaylorModel& z) {
  const double least = leastRoot(z);
  if (!(least > 0.0)) return {0.0, 0.0, 0.0, kInfinity};
  const double inverse = 1.0 / std::sqrt(z.middle);
  const double rest = inverse * squareOfFall(z, least) * (2.0 + least) / (2.0 * least);
  return composed(z, inverse, -0.5 * inverse / z.middle, rest);
}

inline double squareRoot(double x) { return std::sqrt(x); }
inline double inverseSquareRoot(double x) { return 1.0 / std::sqrt(x); }

}  // namespace fcl_prob::detail
