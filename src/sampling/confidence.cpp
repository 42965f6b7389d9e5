// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "sampling/confidence.h"

#include <algorithm>
#include <limits>
#include <string>

#include "base/quantiles.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/monte_carlo.h"

namespace fcl_prob {

Bounds clopperPearsonInterval(std::size_t hits, std::size_t samples, double confidence) {
  if (samples == 0 || hits > samples) {
    throw InvalidRequest(std::to_string(hits) + " hits in " + std::to_string(samples) +
                         " samples have no confidence interval");
  }
  if (!(confidence > 0.0 && confidence < 1.0)) {
    throw InvalidRequest("confidence is " + std::to_string(confidence) + ", must be in (0, 1)");
  }
  const double tail = 0.5 * (1.0 - confidence);
  const auto k = static_cast<double>(hits);
  const auto n = static_cast<double>(samples);
  Bounds bounds{0.0, 1.0};
  if (hits > 0) bounds.lower = detail::betaQuantile(k, n - k + 1.0, tail);
  if (hits < samples) bounds.upper = detail::betaQuantileAbove(k + 1.0, n - k, tail);
  return bounds;
}

namespace detail {
namespace {

constexpr std::size_t kFirstLook = 1024;

/// Share of the error probability that the looks before the last one have among them.
constexpr double kEarlyShare = 0.2;

/// Rounding leaves it between 0 and 1, both excluded.
double confidenceOf(double error) {
  return std::clamp(1.0 - error, std::numeric_limits<double>::min(), 1.0 - 0x1p-53);
}

}  // namespace

LookSchedule::LookSchedule(std::size_t samples, double confidence) : error_(1.0 - confidence) {
  for (std::size_t look = kFirstLook; look < samples; look *= 2) {
    looks_.push_back(look);
    if (look > samples / 2) break;  // the next one may not be a number any more
  }
  looks_.push_back(samples);
}

std::size_t LookSchedule::next(std::size_t done) const {
  return *std::upper_bound(looks_.begin(), looks_.end() - 1, done);
}

double LookSchedule::confidenceAt(std::size_t samples) const {
  if (samples >= looks_.back()) return finalConfidence();
  return confidenceOf(error_ * kEarlyShare / static_cast<double>(looks_.size() - 1));
}

double LookSchedule::finalConfidence() const {
  return confidenceOf(looks_.size() == 1 ? error_ : error_ * (1.0 - kEarlyShare));
}

Bounds gammaInterval(const WeightedHits& hits, double largest_weight, double confidence) {
  const double tail = 0.5 * (1.0 - confidence);
  constexpr double kLeastSquare = 1e-290;  // below that a sum of squares has lost its digits
  Bounds bounds{0.0, 0.0};
  if (hits.sum_squares > kLeastSquare) {
    const double scale = hits.sum_squares / hits.sum;
    bounds.lower = scale * gammaPInverse(hits.sum / scale, tail);
  }
  const double mean = hits.sum + largest_weight;
  const double scale = (hits.sum_squares + largest_weight * largest_weight) / mean;
  bounds.upper = scale * gammaQInverse(mean / scale, tail);
  return bounds;
}

}  // namespace detail
}  // namespace fcl_prob
