// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "gaussian/bet_sequence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/bisection.h"

namespace fcl_prob::detail {
namespace {

// As many samples what was expected counts as.
constexpr double kExpected = 6.0;

// Samples of a finer kind are expected to have this share of the deviation.
constexpr double kOtherKind = 0.6;

// Of the capital, what the largest sample may take.
constexpr double kMostLost = 0.75;

// Factors that are multiplied before their logarithm is taken.
constexpr std::size_t kFactors = 16;

constexpr int kCoarseHalvings = 24;

// Of a logarithm of capital, for rounding.
constexpr double kRoundedLog = 1e-9;

// Of the largest gap: where a mean is not told from the target, stakes are for one that is so much
// less.
constexpr double kLeastGap = 1e-3;

}  // namespace

void BetSequence::changeKind() {
  deviation_ = kOtherKind * std::sqrt(variance());
  expected_ = mean();
  count_ = sum_ = squares_ = 0.0;
}

double BetSequence::mean() const { return expected_ + sum_ / (kExpected + count_); }

double BetSequence::variance() const {
  const double count = kExpected + count_;
  const double off = sum_ / count;
  return std::max(0.0, (kExpected * deviation_ * deviation_ + squares_) / count - off * off);
}

// What makes capital grow fastest, to second order.
double BetSequence::stakeFor(double target, double most) const {
  const double room = most - target;
  const double gap = std::max(target - mean(), kLeastGap * std::max(room, 0.0));
  const double best = gap / (variance() + gap * gap);
  return room > 0.0 ? std::min(best, kMostLost / room) : best;
}

void BetSequence::add(double x, double most, double stake, double count) {
  if (!(stake > 0.0 && count > 0.0)) return;
  bets_.push_back({x, stake, count});
  count_ += count;
  sum_ += count * (x - expected_);
  squares_ += count * (x - expected_) * (x - expected_);
  least_p_ = std::max(least_p_, most - 1.0 / stake);
}

double BetSequence::logCapital(double p) const {
  if (!(p > least_p_)) return -std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (std::size_t i = 0; i < bets_.size();) {
    double product = 1.0;
    const std::size_t end = std::min(bets_.size(), i + kFactors);
    for (; i < end; ++i) {
      const double gain = bets_[i].stake * (p - bets_[i].x);
      if (bets_[i].count == 1.0) {
        product *= 1.0 + gain;
      } else {
        sum += bets_[i].count * std::log1p(gain);
      }
    }
    sum += std::log(product);
  }
  return sum - kRoundedLog * (1.0 + std::fabs(sum));
}

double BetSequence::upper(double error, double most) const {
  const double enough = -std::log(error);
  const double outside = most, inside = std::min(most, mean());
  if (!(logCapital(outside) >= enough)) return most;
  const auto isAgainst = [&](double p) { return logCapital(p) >= enough; };
  return bisect({outside, inside}, kCoarseHalvings, isAgainst).holds;
}

double BetSequence::samplesToTell(double target, double most, double error) const {
  const double gap = target - mean();
  if (!(gap > 0.0)) return std::numeric_limits<double>::infinity();
  const double stake = stakeFor(target, most);
  const double growth = stake * gap - 0.5 * stake * stake * (variance() + gap * gap);
  const double left = -std::log(error) - std::max(0.0, bets_.empty() ? 0.0 : logCapital(target));
  return growth > 0.0 ? std::max(0.0, left) / growth : std::numeric_limits<double>::infinity();
}

}  // namespace fcl_prob::detail
