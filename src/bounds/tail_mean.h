// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Means of the normal distribution's tail over triangles: the closed form of the paper's face
// integral.
#pragma once

#include <array>

namespace fcl_prob::detail {

/// T(l) = erfc(l/√2) = 2 Φ(-l), the field of the divergence-theorem bound up to a factor, and its
/// second antiderivative G(l) = 2 i²erfc(l/√2) = (1 + l²) Φ(-l) - l φ(l), both for one value of l.
struct TailValue {
  explicit TailValue(double l);
  TailValue() = default;

  double l = 0.0;
  double antiderivative = 0.0;  ///< G(l)
  double tail = 0.0;            ///< Φ(-l)
  double density = 0.0;         ///< φ(l)
};

/// Mean of T over a triangle on which l is linear, from its values at the three corners:
/// 2 G[l1, l2, l3], the second divided difference; by a series where the values are close. Relative
/// error below kTailMeanError(least l of the triangle).
double tailMean(TailValue a, TailValue b, TailValue c);

/// Relative error of tailMean(): the antiderivative cancels in the tail.
double tailMeanError(double least_l);

/// Taylor's series of T about one point, for bodies over which l changes little.
class TailSeries {
 public:
  explicit TailSeries(double centre);

  /// Whether the series is exact to rounding for all l within `half_width` of `centre`.
  static bool converges(double centre, double half_width);

  /// Mean over a triangle of T(l) - T(centre). Free of cancellation.
  double meanDifference(double l1, double l2, double l3) const;

  /// Mean over a triangle of T(l).
  double mean(double l1, double l2, double l3) const;

  /// Mean over a segment of G'(l): the first divided difference G[l1, l2].
  double meanSlope(double l1, double l2) const;

 private:
  static constexpr int kTerms = 12;

  double centre_;
  double value_;                             // T(centre)
  double slope_of_antiderivative_;           // G'(centre)
  std::array<double, kTerms> coefficients_;  // T's k-th derivative / k!, from k = 1
};

}  // namespace fcl_prob::detail
