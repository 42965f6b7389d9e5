// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The normal density over a narrow interval as a polynomial: quick where it is asked for often.
#pragma once

#include <array>

namespace fcl_prob::detail {

class DensitySeries {
 public:
  /// Around the middle of [lo, hi], as long as it takes for error() to be at most `accuracy`, but
  /// for rounding. False if that is too long: then it must not be used.
  bool make(double lo, double hi, double accuracy);

  /// φ(y), for y in the interval.
  double density(double y) const { return scale_ * sum(density_, (y - middle_) * inverse_half_); }

  /// ∫ φ from the middle of the interval to y.
  double massFromMiddle(double y) const {
    const double s = (y - middle_) * inverse_half_;
    return mass_scale_ * s * sum(mass_, s);
  }

  /// What density() is, in powers of (y - middle()) inverseHalf(), over scale().
  const double* densityTerms() const { return density_.data(); }

  /// What massFromMiddle() is, over massScale() and over the first power of that.
  const double* massTerms() const { return mass_.data(); }

  int terms() const { return terms_; }
  double middle() const { return middle_; }
  double inverseHalf() const { return inverse_half_; }
  double scale() const { return scale_; }
  double massScale() const { return mass_scale_; }

  /// Bound on the error of density(), relative to it, and of differences of massFromMiddle(),
  /// relative to the mass of the whole interval; rounding included.
  double error() const { return error_; }

 private:
  static constexpr int kMostTerms = 18;

  double sum(const std::array<double, kMostTerms>& coefficients, double s) const {
    double value = 0.0;
    for (int n = terms_ - 1; n >= 0; --n) value = value * s + coefficients[n];
    return value;
  }

  int terms_ = 0;
  double middle_ = 0.0;
  double inverse_half_ = 0.0;
  double scale_ = 0.0;       ///< φ(middle)
  double mass_scale_ = 0.0;  ///< φ(middle) times half of the width
  double error_ = 0.0;
  std::array<double, kMostTerms> density_;  ///< in powers of (y - middle) / half of the width
  std::array<double, kMostTerms> mass_;     ///< of its integral
};

}  // namespace fcl_prob::detail
