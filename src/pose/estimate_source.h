// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// One of the ways to an estimate over random configurations.
#pragma once

#include <optional>

#include "fcl_prob/probability_result.h"
#include "pose/even_regression.h"

namespace fcl_prob::detail {

/// Random work of one kind, of which there may be more: what it does depends on the seed and on
/// what was asked of it before, never on the clock.
class EstimateSource {
 public:
  EstimateSource() = default;
  virtual ~EstimateSource() = default;
  EstimateSource(const EstimateSource&) = delete;
  EstimateSource& operator=(const EstimateSource&) = delete;

  /// Draws more, towards this standard error; less than that once the query is to leave off.
  virtual void draw(double standard_error) = 0;

  /// Nothing before there is enough to tell a standard error.
  virtual std::optional<EstimatedMean> mean() const = 0;

  /// Whether there is enough for mean() to be an answer.
  virtual bool isAnswer() const = 0;

  /// How long the first draw takes, microseconds of some machine: it steers.
  virtual double costOfFirst() const = 0;

  /// The same, to come to a standard error.
  /// Infinite if that cannot be reached. \param probability  as far as it is known
  virtual double costTo(double standard_error, double probability) const = 0;

  /// Adds what was done.
  virtual void describe(ProbabilityResult& result) const = 0;
};

}  // namespace fcl_prob::detail
