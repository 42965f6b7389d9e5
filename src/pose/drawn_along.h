// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Samples along a line on which contact is expected to begin at a known place.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/quantiles.h"
#include "gaussian/normal_density.h"

namespace fcl_prob::detail {

/// Of the normal distribution.
inline double quantileOf(double uniform) {
  return -std::sqrt(2.0) * erfcInverse(2.0 * std::clamp(uniform, 1e-16, 1.0 - 1e-16));
}

/// Where along a line samples are drawn: near the level where contact is expected to begin, and a
/// share of them as the density has them, so that no weight is large wherever contact is.
class DrawnAlong {
 public:
  /// \param as_they_are  the share, in (0, 1): no weight is larger than one over it. The more, the
  ///                     fewer samples bound what none of them shows; the less, the less variance
  ///                     has what they do
  DrawnAlong(double level, double spread, double as_they_are)
      : level_(level),
        scale_(std::max(kScale * spread, kLeastScale)),
        as_they_are_(as_they_are),
        near_(kNearest * (1.0 - as_they_are)),
        around_(1.0 - as_they_are - near_) {}

  double at(double uniform) const {
    double rest = uniform;
    if (rest < near_) return level_ + scale_ * logit(rest / near_);
    rest -= near_;
    if (rest < around_) return level_ + kTimesAround * scale_ * logit(rest / around_);
    return quantileOf((rest - around_) / as_they_are_);
  }

  /// The normal density at s over that of what is drawn.
  double weightAt(double s) const {
    const double wide = kTimesAround * scale_;
    const double density = near_ * logistic((s - level_) / scale_) / scale_ +
                           around_ * logistic((s - level_) / wide) / wide +
                           as_they_are_ * normalDensity(s);
    return normalDensity(s) / density;
  }

 private:
  // Of the samples near the level, what is drawn with the smaller scale.
  static constexpr double kNearest = 0.55;

  // Of the spread.
  static constexpr double kScale = 0.5;
  static constexpr double kLeastScale = 0.01;
  static constexpr double kTimesAround = 4.0;

  static double logit(double p) {
    const double inside = std::clamp(p, 1e-16, 1.0 - 1e-16);
    return std::log(inside / (1.0 - inside));
  }

  static double logistic(double x) {
    const double off = std::exp(-std::fabs(x));
    return off / ((1.0 + off) * (1.0 + off));
  }

  double level_;
  double scale_;
  double as_they_are_;
  double near_;
  double around_;
};

}  // namespace fcl_prob::detail
