// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "gaussian/density_series.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "gaussian/normal_density.h"

namespace fcl_prob::detail {

namespace {

// Over intervals narrower than this rounding of their ends is no longer small.
constexpr double kNarrowestSeries = 1e-6;

// Farther out the density is too small for relative bounds.
constexpr double kFarthestMiddle = 36.0;

// Beyond this the density changes by more than e² over the interval, and rounding counts.
constexpr double kSteepestSeries = 1.0;

}  // namespace

// With c the middle, h half of the width and y = c + h s: φ(y) / φ(c) = g(s) = exp(-c h s - h²
// s²/2) = Σ a_n sⁿ, g' = -(c h + h² s) g, so that (n+1) a_{n+1} = -c h a_n - h² a_{n-1}. The same
// with all signs positive gives b_n >= |a_n|, whose sum is exp(|c| h + h²/2), over which no g(s) is
// below 1. As (n+1) b_{n+1} <= (|c| h + h²) max(b_n, b_{n-1}), what is left out after n terms is at
// most 2 q max(b_{n-1}, b_{n-2}) / (1 - q), q = (|c| h + h²) / n.
bool DensitySeries::make(double lo, double hi, double accuracy) {
  const double half = 0.5 * (hi - lo);
  middle_ = 0.5 * (lo + hi);
  const double linear = middle_ * half;
  const double square = half * half;
  const double steepness = std::fabs(linear) + square;
  if (!(half > kNarrowestSeries && steepness <= kSteepestSeries)) return false;
  if (std::fabs(middle_) > kFarthestMiddle) return false;
  double before = 0.0;
  double bound_before = 0.0;
  double term = 1.0;
  double bound = 1.0;
  double bounds = 1.0;
  density_[0] = mass_[0] = 1.0;
  for (int n = 1; n < kMostTerms; ++n) {
    const double inverse = 1.0 / n;
    const double next = -(linear * term + square * before) * inverse;
    const double next_bound = (std::fabs(linear) * bound + square * bound_before) * inverse;
    before = term;
    bound_before = bound;
    term = next;
    bound = next_bound;
    bounds += bound;
    density_[n] = term;
    mass_[n] = term / (n + 1);
    const double share = steepness / (n + 1);
    const double rest = 2.0 * share * std::max(bound, bound_before) / (1.0 - share);
    // Over the least of g, which is 1 over the sum of all bounds; |s| may be rounded above 1.
    const double off = rest * (bounds + rest) * (1 + 1e-6);
    if (!(share <= 0.5) || off > accuracy) continue;
    terms_ = n + 1;
    inverse_half_ = 1.0 / half;
    scale_ = normalDensity(middle_);
    mass_scale_ = scale_ * half;
    // A coefficient is rounded by 4 n ε of its bound, a sum by 2 n ε of all; s by 2 ε and by what
    // the rounding of the middle, an ε of its size, is of h; the density at the middle by a few ε.
    const double of_s = 2.0 + std::fabs(middle_) * inverse_half_;
    const double rounding = kEpsilon * (6.0 * terms_ + 16.0 + of_s * steepness);
    error_ = off + 2.0 * rounding * bounds * bounds;
    return true;
  }
  return false;
}

}  // namespace fcl_prob::detail
