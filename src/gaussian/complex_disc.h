// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Arithmetic of discs in the complex plane, by which functions are bounded around real ranges.
#pragma once

#include <cmath>

#include "gaussian/constants.h"

namespace fcl_prob::detail {

/// All complex numbers within `radius` of a real one. Results of operations contain whatever comes
/// of numbers in the operands, rounding included; where nothing is known the radius is not finite.
struct ComplexDisc {
  ComplexDisc() = default;
  ComplexDisc(double real) : middle(real) {}  // NOLINT(google-explicit-constructor)
  ComplexDisc(double real, double range) : middle(real), radius(range) {}

  /// No less than any |z|.
  double most() const { return (std::abs(middle) + radius) * (1.0 + kEpsilon); }

  double middle = 0.0, radius = 0.0;
};

/// A computed middle, wrong by a rounding, and a radius of a few terms.
inline ComplexDisc roundedDisc(double middle, double radius) {
  return {middle, radius * (1.0 + 8.0 * kEpsilon) + 2.0 * kEpsilon * std::abs(middle)};
}

inline ComplexDisc operator+(const ComplexDisc& a, const ComplexDisc& b) {
  return roundedDisc(a.middle + b.middle, a.radius + b.radius);
}

inline ComplexDisc operator-(const ComplexDisc& a, const ComplexDisc& b) {
  return roundedDisc(a.middle - b.middle, a.radius + b.radius);
}

inline ComplexDisc operator*(const ComplexDisc& a, const ComplexDisc& b) {
  return roundedDisc(a.middle * b.middle,
                     std::abs(a.middle) * b.radius + a.radius * (std::abs(b.middle) + b.radius));
}

inline ComplexDisc operator*(double a, const ComplexDisc& b) {
  return roundedDisc(a * b.middle, std::abs(a) * b.radius);
}

/// √z for Re z > 0: |√z - √m| = |z - m| / |√z + √m|, and Re √z >= √(Re z).
inline ComplexDisc squareRoot(const ComplexDisc& z) {
  const double least = z.middle - z.radius;
  if (!(least > 0.0)) return {0.0, kInfinity};
  const double middle = std::sqrt(z.middle);
  return roundedDisc(middle, z.radius / (middle + std::sqrt(least)));
}

/// 1/√z for Re z > 0: |1/√z - 1/√m| = |√z - √m| / |√z √m|.
inline ComplexDisc inverseSquareRoot(const ComplexDisc& z) {
  const double least = z.middle - z.radius;
  if (!(least > 0.0)) return {0.0, kInfinity};
  const double middle = std::sqrt(z.middle), end = std::sqrt(least);
  return roundedDisc(1.0 / middle, z.radius / (middle + end) / (middle * end));
}

inline double squareRoot(double x) { return std::sqrt(x); }
inline double inverseSquareRoot(double x) { return 1.0 / std::sqrt(x); }

}  // namespace fcl_prob::detail
