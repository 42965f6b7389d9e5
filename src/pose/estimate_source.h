// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What an estimate over configurations is drawn from.
#pragma once

#include <cstddef>

#include "fcl_prob/probability_result.h"
#include "gaussian/mean_sequence.h"

namespace fcl_prob::detail {

/// Independent samples whose mean, added to offset(), is P. What is drawn depends on the seed and
/// on what was asked of it before, never on the clock.
class EstimateSource {
 public:
  EstimateSource() = default;
  virtual ~EstimateSource() = default;
  EstimateSource(const EstimateSource&) = delete;
  EstimateSource& operator=(const EstimateSource&) = delete;

  /// Draws until there are so many samples; less once the query is to leave off.
  /// \param tolerance  of the standard error of P that is wanted: it steers
  virtual void drawTo(std::size_t count, double tolerance) = 0;

  virtual const MeanSequence& samples() const = 0;

  /// What the samples yet to come are to tell P from (see MeanSequence::aim).
  virtual void aim(double below, double above) = 0;

  virtual double offset() const = 0;

  /// How many samples the limit on cells allows, about.
  virtual double mostSamples() const = 0;

  /// Adds what was done.
  virtual void describe(ProbabilityResult& result) const = 0;
};

}  // namespace fcl_prob::detail
