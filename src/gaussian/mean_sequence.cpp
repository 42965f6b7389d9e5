// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "gaussian/mean_sequence.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

// Hits that are added to those seen; see the class.
constexpr double kUnseenHits = 4.0;

// Standard errors within which a mean is likely. Stakes go by it, not what holds.
constexpr double kLikely = 4.0;

// Of the capital, what the largest sample may take.
constexpr double kMostTaken = 0.75;

}  // namespace

MeanSequence::MeanSequence(const Bounds& range, double hit, double expected, double deviation)
    : range_(range), hit_(hit), above_(expected, deviation), below_(-expected, deviation) {
  aim(range.lower, range.upper);
}

// What a stake says holds for means only with which no sample could have taken all capital: it is
// no larger than what leaves some for all means that are still likely.
void MeanSequence::aim(double below, double above) {
  const double reach = count_ >= 2.0 ? kLikely * standardError() : kInfinity;
  const double least = std::max(range_.lower, mean() - reach);
  const double most = std::min(range_.upper, mean() + reach);
  stake_above_ = std::min(above_.stakeFor(std::min(above, range_.upper), range_.upper),
                          kMostTaken / (range_.upper - least));
  stake_below_ = std::min(below_.stakeFor(-std::max(below, range_.lower), -range_.lower),
                          kMostTaken / (most - range_.lower));
}

void MeanSequence::add(const Bounds& x, double count) {
  above_.add(std::min(x.upper, range_.upper), range_.upper, stake_above_, count);
  below_.add(std::min(-x.lower, -range_.lower), -range_.lower, stake_below_, count);
  const double middle = x.middle();
  count_ += count;
  sum_ += count * middle;
  squares_ += count * middle * middle;
  doubt_ += 0.5 * count * x.width();
}

double MeanSequence::deviation() const {
  if (count_ < 2.0) return kInfinity;
  const double off = sum_ / count_;
  return std::sqrt(std::max(0.0, squares_ / count_ - off * off) * count_ / (count_ - 1.0));
}

double MeanSequence::spreadError() const {
  if (count_ < 2.0) return kInfinity;
  return deviation() / std::sqrt(count_) + doubt_ / count_;
}

double MeanSequence::standardError() const {
  if (count_ < 2.0) return kInfinity;
  return std::hypot(deviation() / std::sqrt(count_), std::sqrt(kUnseenHits) * hit_ / count_) +
         doubt_ / count_;
}

// The n with deviation²/n + unseen²/n² = tolerance².
double MeanSequence::samplesFor(double deviation, double hit, double tolerance) {
  if (!(tolerance > 0.0)) return kInfinity;
  const double by_spread = 0.5 * std::pow(deviation / tolerance, 2);
  const double by_unseen = std::sqrt(kUnseenHits) * hit / tolerance;
  return by_spread + std::hypot(by_spread, by_unseen);
}

Bounds MeanSequence::interval(double error) const {
  return {-below_.upper(0.5 * error, -range_.lower), above_.upper(0.5 * error, range_.upper)};
}

double MeanSequence::samplesToTell(double p, double error) const {
  return std::min(above_.samplesToTell(p, range_.upper, 0.5 * error),
                  below_.samplesToTell(-p, -range_.lower, 0.5 * error));
}

}  // namespace fcl_prob::detail
