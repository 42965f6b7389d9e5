// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "gaussian/hit_sequence.h"

#include <cmath>

#include "base/bisection.h"
#include "base/constants.h"
#include "base/quantiles.h"

namespace fcl_prob::detail {
namespace {

constexpr int kHalvings = 60;

// Not std::lgamma, which writes a global.
double logBeta(double a, double b) { return logGamma(a) + logGamma(b) - logGamma(a + b); }

/// Against that a hit has the probability p, by the likelihood.
class Evidence {
 public:
  Evidence(double hits, double misses)
      : hits_(hits),
        misses_(misses),
        mean_(logBeta(0.5 + hits, 0.5 + misses) - logBeta(0.5, 0.5)) {}

  double logAgainst(double p) const {
    if (p <= 0.0 && hits_ > 0.0) return kInfinity;
    if (p >= 1.0 && misses_ > 0.0) return kInfinity;
    double sum = mean_;
    if (hits_ > 0.0) sum -= hits_ * std::log(p);
    if (misses_ > 0.0) sum -= misses_ * std::log1p(-p);
    return sum;
  }

  double end(double outside, double inside, double enough) const {
    if (!(logAgainst(outside) >= enough)) return outside;
    const auto isAgainst = [&](double p) { return logAgainst(p) >= enough; };
    return bisect({outside, inside}, kHalvings, isAgainst).holds;
  }

 private:
  double hits_;
  double misses_;
  double mean_;  ///< logarithm of the likelihood's mean over the prior
};

}  // namespace

Bounds HitSequence::interval(double error) const {
  if (samples_ == 0) return {0.0, 1.0};
  const double hits = static_cast<double>(hits_);
  const double samples = static_cast<double>(samples_);
  const Evidence evidence(hits, samples - hits);
  const double enough = -std::log(error);
  return {evidence.end(0.0, hits / samples, enough), evidence.end(1.0, hits / samples, enough)};
}

}  // namespace fcl_prob::detail
