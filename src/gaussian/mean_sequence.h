// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A mean of bounded variables from independent samples: an interval that holds at every moment for
// every distribution, and a standard error.
#pragma once

#include "fcl_prob/bounds.h"
#include "gaussian/bet_sequence.h"

namespace fcl_prob::detail {

/// Samples are independent, all of the same mean m, and certainly within a known range.
///
/// interval() is two BetSequences, one against all means above m and one against all below: it
/// needs no other property of the distribution, and one may look as often as one likes and stop
/// when one likes.
///
/// standardError() is that of independent samples, with four hits added that were not seen
/// (Agresti and Coull 1998): where few samples are all that makes up m, their own spread is most
/// often too small. With the four, six standard errors miss the mean of a Poisson number of hits
/// with a chance below 1e-5 whatever that mean is, none seen included.
class MeanSequence {
 public:
  /// \param range      of samples
  /// \param hit        what a draw that shows something which was never seen may add to a sample:
  ///                   the largest weight of a sample, times the share of it that is one draw
  /// \param expected, deviation  of samples, before there are any: they steer
  MeanSequence(const Bounds& range, double hit, double expected, double deviation);

  /// What the next samples are to tell m from: stakes go by it. Not needed to be right.
  void aim(double below, double above);

  void add(double x) { add({x, x}, 1.0); }

  /// \param x  the sample is only known to lie within, or its mean is: then m is the mean of those
  void add(const Bounds& x, double count);

  double count() const { return count_; }
  double mean() const { return count_ > 0.0 ? sum_ / count_ : 0.0; }

  /// Of one sample.
  double deviation() const;

  /// Infinite before there are two samples.
  double standardError() const;

  /// Its part that is the spread of the samples alone.
  double spreadError() const;

  /// So many samples of equal size would have this mean and this spread around 0: of how many hits
  /// the mean is made.
  double effectiveSamples() const { return squares_ > 0.0 ? sum_ * sum_ / squares_ : 0.0; }

  /// With how many samples standardError() comes to a tolerance, if they go on as they were; and
  /// with how many samples of such a deviation and such a hit.
  double samplesFor(double tolerance) const { return samplesFor(deviation(), hit_, tolerance); }
  static double samplesFor(double deviation, double hit, double tolerance);

  /// Contains m at this moment and at all others but for a chance of at most `error`.
  Bounds interval(double error) const;

  /// About how many samples more it takes until interval(error) is without p.
  double samplesToTell(double p, double error) const;

 private:
  Bounds range_;
  double hit_;
  BetSequence above_;  ///< tells what m is not above
  BetSequence below_;  ///< the same for -m
  double stake_above_ = 0.0;
  double stake_below_ = 0.0;
  double count_ = 0.0;
  double sum_ = 0.0;
  double squares_ = 0.0;
  double doubt_ = 0.0;  ///< sum of half the widths of samples
};

}  // namespace fcl_prob::detail
