// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "gaussian/hit_sequence.h"

#include <cmath>
#include <limits>

#include "base/quantiles.h"

namespace fcl_prob::detail {
namespace {

// Of a bisection; the end that is taken is outside of the interval.
constexpr int kHalvings = 60;

// Not std::lgamma, which writes a global.
double logBeta(double a, double b) { return logGamma(a) + logGamma(b) - logGamma(a + b); }

}  // namespace

double HitSequence::logEvidenceAgainst(double p) const {
  const double hits = static_cast<double>(hits_);
  const double misses = static_cast<double>(samples_) - hits;
  const double infinite = std::numeric_limits<double>::infinity();
  if (p <= 0.0 && hits > 0.0) return infinite;
  if (p >= 1.0 && misses > 0.0) return infinite;
  double sum = logBeta(0.5 + hits, 0.5 + misses) - logBeta(0.5, 0.5);
  if (hits > 0.0) sum -= hits * std::log(p);
  if (misses > 0.0) sum -= misses * std::log1p(-p);
  return sum;
}

double HitSequence::end(double outside, double inside, double enough) const {
  if (!(logEvidenceAgainst(outside) >= enough)) return outside;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (outside + inside);
    (logEvidenceAgainst(middle) >= enough ? outside : inside) = middle;
  }
  return outside;
}

Bounds HitSequence::interval(double error) const {
  if (samples_ == 0) return {0.0, 1.0};
  const double likeliest = static_cast<double>(hits_) / static_cast<double>(samples_);
  const double enough = -std::log(error);
  return {end(0.0, likeliest, enough), end(1.0, likeliest, enough)};
}

}  // namespace fcl_prob::detail
