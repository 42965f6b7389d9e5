// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The estimate from answers given the configuration, at configurations in antithetic pairs.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>

#include "base/budget.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/random_configuration.h"
#include "pose/configuration_mixture.h"
#include "pose/estimate_source.h"

namespace fcl_prob::detail {

/// The probability given a configuration, which leaves a translation; called from several threads.
using ConditionalAnswer =
    std::function<ProbabilityResult(const PlacedConfiguration&, const ProbabilityRequest&)>;

/// A sample is the mean of P given z and P given -z: what is odd in z cancels.
class PairSource : public EstimateSource {
 public:
  /// Keeps references to all arguments.
  PairSource(const ConfigurationMixture& mixture, const ConditionalAnswer& answer,
             const ProbabilityRequest& request, Budget& watch);

  /// Pairs of the least answer: their spread then tells something.
  static constexpr std::size_t kLeastPairs = 32;

  void drawTo(std::size_t count, double tolerance) override;
  const MeanSequence& samples() const override { return samples_; }
  void aim(double below, double above) override { samples_.aim(below, above); }
  double offset() const override { return 0.0; }
  double mostSamples() const override;
  void describe(ProbabilityResult& result) const override;

  /// Mean and standard error of the gradients, if they were asked for and all pairs have one.
  void fillGradient(ProbabilityResult& result) const;

 private:
  /// One configuration answered.
  struct Answer {
    Bounds value{0.0, 1.0};
    bool complete = false;
    std::optional<Eigen::Vector3d> gradient;
    Eigen::Vector3d largest_gradient = Eigen::Vector3d::Zero();
    ProbabilityStatistics statistics;
  };

  Answer answerAt(std::size_t index, double tolerance) const;
  void add(const Answer& at_z, const Answer& at_opposite);
  void addStatistics(const ProbabilityStatistics& of_one);

  const ConfigurationMixture& mixture_;
  const ConditionalAnswer& answer_;
  const ProbabilityRequest& request_;
  Budget& watch_;
  MeanSequence samples_;
  std::size_t pairs_ = 0;
  std::size_t gradients_ = 0;
  Eigen::Vector3d gradient_sum_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d gradient_squares_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d largest_gradient_ = Eigen::Vector3d::Zero();
  ProbabilityStatistics statistics_;
};

}  // namespace fcl_prob::detail
