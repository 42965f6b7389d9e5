// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The estimate from calls of fcl::collide at points that fill the space evenly, near where contact
// begins: randomised quasi-Monte Carlo over configurations and translations at once.
#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/random/sobol.hpp>
#include <cstdint>
#include <optional>
#include <vector>

#include "fcl_prob/random_configuration.h"
#include "montecarlo/placement_collider.h"
#include "pose/boundary_model.h"
#include "pose/estimate_source.h"
#include "pose/run_watch.h"

namespace fcl_prob::detail {

/// What a quadric along the boundary of contact has of the mass is known (BoundaryModel). Where it
/// follows that closely, counted is only what it is wrong by, mostly at points near it, weighted
/// with the density there over that of the points: unbiased, whatever the quadric is like. Where
/// not, contacts are counted and what the quadric explains of them is taken out by regression.
/// Points of a Sobol sequence are used several times with random digital shifts (L'Ecuyer and
/// Lemieux 2002): what these differ by tells the standard error.
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
  bool isAnswer() const override;
  double costOfFirst() const override;
  double costTo(double standard_error, double probability) const override;
  void describe(ProbabilityResult& result) const override;

 private:
  static constexpr std::size_t kShifts = 32;

  /// A sample: what is counted of it, and a control variate of mean 0.
  struct Counted {
    double value = 0.0;
    double control = 0.0;
    bool hit = false;
  };
  using Sums = Eigen::Array<double, kShifts, 1>;
  using CountedShifts = std::array<Counted, kShifts>;

  Eigen::Index dimension() const { return static_cast<Eigen::Index>(shifts_.size()); }
  bool collidesAt(const Eigen::VectorXd& x) const;
  void findBoundary(double standard_error);
  double varianceNear() const;
  std::size_t pointsOfShare(double share) const;
  std::size_t leastPoints() const;
  std::size_t pointsTo(double standard_error) const;
  CountedShifts countAt(std::size_t point) const;
  Counted countOne(const Eigen::VectorXd& uniform) const;
  Counted countNear(const Eigen::VectorXd& across, double uniform) const;
  void takeMean();
  bool deviationPays() const;
  void countAll();

  const RandomConfiguration& configuration_;
  const GeometryList& a_;
  const GeometryList& b_;
  const ProbabilityRequest& request_;
  RunWatch& watch_;
  double cost_of_sample_;
  std::optional<PlacementCollider> collider_;  ///< made when it is used first
  boost::random::sobol sequence_;
  std::vector<std::array<std::uint64_t, kShifts>> shifts_;  ///< of every coordinate
  std::optional<BoundaryModel> model_;                      ///< nothing: all is counted
  double mass_ = 0.0;                                       ///< of the model
  std::size_t questions_ = 0;                               ///< that it took
  bool is_close_ = false;                                   ///< the model, to the boundary
  Sums values_ = Sums::Zero();
  Sums controls_ = Sums::Zero();
  double largest_ = 0.0;  ///< of the values
  std::size_t hits_ = 0;
  std::size_t points_ = 0;
  std::optional<EstimatedMean> mean_;
};

}  // namespace fcl_prob::detail
