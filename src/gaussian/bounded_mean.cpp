// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "gaussian/bounded_mean.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fcl_prob::detail {
namespace {

constexpr double kDeviationsHeld = 6.0;

// Chance that a mean is off by more than so many standard errors, above or below. A normal
// distribution has 2e-9, which would add a tenth to every standard error, however many samples
// tell.
constexpr double kChanceBeyond = 1e-6;

// Of the capital, what the largest sample may take.
constexpr double kLargestLoss = 0.99;

// The largest stake, where no sample can lose it, in units of one over the scale of samples.
constexpr double kLargestStake = 16.0;

// Factors that are multiplied before their logarithm is taken: none is below 0.01 or far above 17.
constexpr int kFactorsOfProduct = 64;

double scaleOf(double least, double most) {
  const double scale = std::max(-least, most);
  return scale > 0.0 && std::isfinite(scale) ? scale : 1.0;
}

}  // namespace

MeanBound::MeanBound(double most, double scale) : most_(most), scale_(scale) {
  double stake = most > 0.0 ? std::min(kLargestStake, kLargestLoss * scale / most) : kLargestStake;
  for (double& one : stakes_) {
    one = stake;
    stake *= 0.5;
  }
}

void MeanBound::add(double x) {
  const double of_scale = std::min(x, most_) / scale_;
  product_ *= 1.0 - stakes_ * of_scale;
  if (++in_product_ < kFactorsOfProduct) return;
  sums_ = logarithms();
  product_.setOnes();
  in_product_ = 0;
}

MeanBound::Stakes MeanBound::logarithms() const { return sums_ + product_.log(); }

double MeanBound::upper(double count, double error) const {
  if (!std::isfinite(most_)) return most_;
  const double share = std::log(kStakes / error);
  const Stakes of_sample = (logarithms() - share) / count;
  double upper = most_;
  for (int i = 0; i < kStakes; ++i) {
    upper = std::min(upper, -std::expm1(of_sample[i]) / stakes_[i] * scale_);
  }
  return upper;
}

BoundedMean::BoundedMean(double least, double most)
    : scale_(scaleOf(least, most)), above_(most, scale_), below_(-least, scale_) {}

void BoundedMean::add(double x) {
  sum_ += x;
  squares_ += x / scale_ * (x / scale_);
  above_.add(x);
  below_.add(-x);
}

double BoundedMean::standardError(double count) const {
  if (count < 2.0) return std::numeric_limits<double>::infinity();
  const double of_scale = mean(count) / scale_;
  const double variance = (squares_ / count - of_scale * of_scale) / (count - 1.0);
  const double above = above_.upper(count, 0.5 * kChanceBeyond) - mean(count);
  const double below = below_.upper(count, 0.5 * kChanceBeyond) + mean(count);
  return std::max({scale_ * std::sqrt(std::max(variance, 0.0)), above / kDeviationsHeld,
                   below / kDeviationsHeld});
}

}  // namespace fcl_prob::detail
