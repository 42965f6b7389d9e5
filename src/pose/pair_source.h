// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The estimate from answers given the configuration, in antithetic pairs.
#pragma once

#include "pose/conditional_samples.h"
#include "pose/estimate_source.h"
#include "pose/query_costs.h"

namespace fcl_prob::detail {

class PairSource : public EstimateSource {
 public:
  /// Keeps references to all arguments. \param cost  of an answer
  PairSource(const RandomConfiguration& configuration, const ConditionalAnswer& answer,
             const QueryCost& cost, const ProbabilityRequest& request, RunWatch& watch);

  void draw(double standard_error) override;
  std::optional<EstimatedMean> mean() const override { return mean_; }
  bool isAnswer() const override;
  double costOfFirst() const override;
  double costTo(double standard_error, double probability) const override;
  void describe(ProbabilityResult& result) const override;
  const ProbabilityStatistics& statistics() const { return samples_.statistics(); }

 private:
  double count() const { return static_cast<double>(samples_.pairs().size()); }
  InnerTolerance firstTolerance() const;
  InnerTolerance nextTolerance(double standard_error) const;
  double pairsTo(double standard_error) const;
  double pairsAtFirst(double standard_error) const;
  double costOfAnswer() const;

  const RandomConfiguration& configuration_;
  QueryCost cost_;
  const ProbabilityRequest& request_;
  ConditionalSamples samples_;
  std::optional<EstimatedMean> mean_;
};

}  // namespace fcl_prob::detail
