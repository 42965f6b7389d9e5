// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Standard errors of means that hold also where only few samples tell anything.
#pragma once

#include <Eigen/Core>

namespace fcl_prob::detail {

/// A bound from above on the mean of a distribution, by independent samples of it.
///
/// Of a stake κ the capital Π (1 - κ x_i) / (1 - κ m) of `count` samples has the mean 1 if m is the
/// mean of the distribution: so it exceeds 1/error with a chance of at most `error`, whatever the
/// distribution (Waudby-Smith and Ramdas, Estimating means of bounded random variables by betting,
/// 2024). Several stakes at once, each with its share of the error, are near the best one.
class MeanBound {
 public:
  /// \param most   no sample is larger (one that is counts as that): >= 0, may be infinite
  /// \param scale  of the samples: > 0 where they are not all 0
  MeanBound(double most, double scale);

  /// Samples that are 0 need not be added.
  void add(double x);

  /// Certainly but for a chance of `error` no less than the mean; no more than `most`.
  double upper(double count, double error) const;

 private:
  static constexpr int kStakes = 16;
  using Stakes = Eigen::Array<double, kStakes, 1>;

  Stakes logarithms() const;

  double most_;
  double scale_;
  Stakes stakes_;                    ///< in units of 1 / scale
  Stakes sums_ = Stakes::Zero();     ///< of logarithms of factors
  Stakes product_ = Stakes::Ones();  ///< of those that are not in the sums yet
  int in_product_ = 0;
};

/// The mean of independent samples, and its standard error, which is never less than what makes six
/// of it hold with a chance of 1 - 1e-6 whatever the distribution is: where few samples tell
/// anything what their differences tell is too small, and nothing at all where all of them are 0.
class BoundedMean {
 public:
  /// Of samples within [least, most]: least <= 0 <= most, either may be infinite.
  BoundedMean(double least, double most);

  /// Samples that are 0 need not be added.
  void add(double x);

  double mean(double count) const { return sum_ / count; }

  /// Infinite if it is not known: without bounds, or of one sample.
  double standardError(double count) const;

 private:
  double sum_ = 0.0;
  double squares_ = 0.0;  ///< of samples in units of scale_
  double scale_;
  MeanBound above_;
  MeanBound below_;  ///< of what is opposite
};

}  // namespace fcl_prob::detail
