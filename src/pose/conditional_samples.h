// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Answers at random configurations, in antithetic pairs, on several threads.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "pose/configuration_estimate.h"
#include "pose/even_regression.h"
#include "pose/run_watch.h"

namespace fcl_prob::detail {

/// How accurate the answer at one configuration shall be; its standard error.
struct InnerTolerance {
  double relative = 0.0;
  double absolute = 0.0;
};

class ConditionalSamples {
 public:
  /// Keeps references to all arguments.
  ConditionalSamples(const RandomConfiguration& configuration, const ConditionalAnswer& answer,
                     const ProbabilityRequest& request, RunWatch& watch);

  /// Adds pairs until there are `count`, or a limit is reached: then only those before the first
  /// one that is not answered count.
  void drawTo(std::size_t count, const InnerTolerance& tolerance);

  const std::vector<AntitheticPair>& pairs() const { return pairs_; }

  /// Some configuration left less than three directions to the translation: P given the
  /// configuration then may jump.
  bool mayJump() const { return may_jump_; }

  /// Bound on the mean of what single answers leave open that are no samples.
  double doubt() const { return pairs_.empty() ? 0.0 : doubt_ / (2.0 * countOfPairs()); }

  /// Sums over all answers; peaks: maxima.
  const ProbabilityStatistics& statistics() const { return statistics_; }

  /// Mean and standard error of the gradients, if they were asked for and there are some.
  void fillGradient(ProbabilityResult& result) const;

 private:
  /// One configuration answered.
  struct Answer {
    double value = 0.0;
    double doubt = 0.0;
    bool may_jump = false;
    bool complete = false;
    std::optional<Eigen::Vector3d> gradient;
    ProbabilityStatistics statistics;
  };

  double countOfPairs() const { return static_cast<double>(pairs_.size()); }
  Eigen::VectorXd normals(std::size_t pair) const;
  Answer answerAt(std::size_t index, const InnerTolerance& tolerance) const;
  void add(std::size_t pair, const Answer& at_z, const Answer& at_opposite);
  void addStatistics(const ProbabilityStatistics& of_one);

  const RandomConfiguration& configuration_;
  const ConditionalAnswer& answer_;
  const ProbabilityRequest& request_;
  RunWatch& watch_;
  std::vector<AntitheticPair> pairs_;
  std::vector<Eigen::Vector3d> gradients_;  ///< of pairs
  ProbabilityStatistics statistics_;
  double doubt_ = 0.0;
  bool may_jump_ = false;
};

}  // namespace fcl_prob::detail
