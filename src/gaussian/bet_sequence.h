// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A bound on a mean from above, as told by bets on samples at every moment.
#pragma once

#include <cstddef>
#include <vector>

namespace fcl_prob::detail {

/// Of samples x whose mean, given all that was drawn before, is no less than m, and which are
/// certainly no more than some bound.
///
/// Who bets against the mean p, staking a share λ of what he has for a unit, has his capital
/// multiplied by 1 + λ(p - x) at every sample. If p is no more than m that is a supermartingale
/// which exceeds 1/error ever with a chance of at most `error` (Ville 1939; Waudby-Smith and
/// Ramdas, Estimating means of bounded random variables by betting, 2024): whoever is right that
/// often may say at any moment that m is less than every p for which it has. Stakes may depend on
/// all samples before; samples may be unboundedly small.
class BetSequence {
 public:
  /// Shares of the capital to stake are to tell `target` from a mean that is less.
  /// \param expected, deviation  of samples, before there are any
  BetSequence(double expected, double deviation) : expected_(expected), deviation_(deviation) {}

  /// The stake for the next samples. \param most  of those: >= target
  double stakeFor(double target, double most) const;

  /// \param count  samples that are all equal to x
  void add(double x, double most, double stake, double count = 1.0);

  /// Samples are of a finer kind from now on: what those before told counts as expected.
  void changeKind();

  /// Of the last kind.
  double samplesOfKind() const { return count_; }

  /// Of samples, about; the expected values count as some of them.
  double mean() const;
  double variance() const;

  /// Certainly but for the error more than m, at this moment and at all others; `most` if nothing
  /// is told below that. \param error  chance that it ever fails, in (0, 1)
  double upper(double error, double most) const;

  /// How many samples it will take, about, until upper() is no more than the target.
  double samplesToTell(double target, double most, double error) const;

 private:
  struct Bet {
    double x;
    double stake;
    double count;
  };

  double logCapital(double p) const;

  double expected_;
  double deviation_;
  std::vector<Bet> bets_;
  double count_ = 0.0;       ///< of samples of the last kind
  double sum_ = 0.0;         ///< of them, less what was expected
  double squares_ = 0.0;     ///< of those differences
  double least_p_ = -1e300;  ///< below, capital might have become negative
};

}  // namespace fcl_prob::detail
