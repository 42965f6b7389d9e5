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

/// Where along a line samples are drawn: near the level where contact is expected to begin; some as
/// the density has them and some far out, so that no weight is large wherever contact is.
class DrawnAlong {
 public:
  DrawnAlong(double level, double spread)
      : level_(level), scale_(std::max(kScale * spread, kLeastScale)) {}

  /// No weight is larger.
  static constexpr double largestWeight() { return 1.0 / kAsTheyAre; }

  double at(double uniform) const {
    double rest = uniform;
    if (rest < kNear) return level_ + scale_ * logit(rest / kNear);
    rest -= kNear;
    if (rest < kAround) return level_ + around() * logit(rest / kAround);
    rest -= kAround;
    if (rest < kAsTheyAre) return quantileOf(rest / kAsTheyAre);
    return kWide * quantileOf((rest - kAsTheyAre) / kFarOut);
  }

  /// The normal density at s over that of what is drawn.
  double weightAt(double s) const {
    const double density = kNear * logistic((s - level_) / scale_) / scale_ +
                           kAround * logistic((s - level_) / around()) / around() +
                           kAsTheyAre * normalDensity(s) +
                           kFarOut * normalDensity(s / kWide) / kWide;
    return normalDensity(s) / density;
  }

 private:
  // Shares of samples, and the deviation of those far out. More as they are: smaller weights, so
  // that fewer samples bound what none of them shows; more near: less variance of what they do.
  static constexpr double kNear = 0.25;
  static constexpr double kAround = 0.2;
  static constexpr double kAsTheyAre = 0.45;
  static constexpr double kFarOut = 0.1;
  static constexpr double kWide = 2.5;

  // Of the spread.
  static constexpr double kScale = 0.5;
  static constexpr double kLeastScale = 0.01;
  static constexpr double kTimesAround = 4.0;

  double around() const { return kTimesAround * scale_; }

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
};

}  // namespace fcl_prob::detail
