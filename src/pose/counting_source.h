// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The estimate from calls of fcl::collide at points that fill the space evenly: randomised
// quasi-Monte Carlo over configurations and translations at once.
#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/random/sobol.hpp>
#include <cstdint>
#include <optional>
#include <vector>

#include "fcl_prob/random_configuration.h"
#include "montecarlo/placement_collider.h"
#include "pose/estimate_source.h"
#include "pose/run_watch.h"

namespace fcl_prob::detail {

/// Points of a Sobol sequence, used several times with random digital shifts (L'Ecuyer and Lemieux
/// 2002): each shifted set alone is unbiased, and what they differ by tells the standard error. For
/// poses it takes five to ten times fewer samples than counting at random points.
class CountingSource : public EstimateSource {
 public:
  /// Keeps references to all arguments.
  CountingSource(const RandomConfiguration& configuration, const GeometryList& a,
                 const GeometryList& b, const ProbabilityRequest& request, RunWatch& watch);

  /// Whether fcl::collide answers for such a query, and to an accuracy that does not matter.
  static bool isFor(const RandomConfiguration& configuration, const GeometryList& a,
                    const GeometryList& b, const ProbabilityRequest& request);

  void draw(double standard_error) override;
  std::optional<EstimatedMean> mean() const override { return mean_; }
  bool isAnswer() const override { return mean_.has_value(); }
  double costOfFirst() const override;
  double costTo(double standard_error, double probability) const override;
  void describe(ProbabilityResult& result) const override;

 private:
  static constexpr std::size_t kShifts = 32;
  using Hits = std::uint32_t;  ///< a bit for every shift

  std::size_t pointsTo(double standard_error) const;
  Hits hitsAt(std::size_t point) const;
  void takeMean();

  const RandomConfiguration& configuration_;
  const GeometryList& a_;
  const GeometryList& b_;
  const ProbabilityRequest& request_;
  RunWatch& watch_;
  double cost_of_sample_;
  std::optional<PlacementCollider> collider_;  ///< made when it is used first
  boost::random::sobol sequence_;
  std::vector<std::array<std::uint64_t, kShifts>> shifts_;  ///< of every coordinate
  std::array<std::size_t, kShifts> hits_{};
  std::size_t points_ = 0;
  std::optional<EstimatedMean> mean_;
};

}  // namespace fcl_prob::detail
