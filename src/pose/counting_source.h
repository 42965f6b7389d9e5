// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The estimate from calls of fcl::collide at random configurations and translations at once, mostly
// near where contact begins.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/budget.h"
#include "pose/boundary_model.h"
#include "pose/boundary_search.h"
#include "pose/configuration_mixture.h"
#include "pose/estimate_source.h"
#include "sampling/placement_collider.h"

namespace fcl_prob::detail {

/// What a quadric along the boundary of contact has of the mass is known (BoundaryModel). Counted
/// is what it is wrong by, mostly at points near it, weighted with the density there over that of
/// the points: unbiased, whatever the quadric is like, and bounded, since a share of the points is
/// drawn as the density has them. Where the quadric is no help, contacts are counted as they are.
class CountingSource : public EstimateSource {
 public:
  /// Keeps references to all arguments.
  CountingSource(const ConfigurationMixture& mixture, const GeometryList& a, const GeometryList& b,
                 const ProbabilityRequest& request, Budget& watch);

  /// Whether fcl::collide answers for such a query, and to an accuracy that does not matter.
  static bool isFor(const ConfigurationMixture& mixture, const GeometryList& a,
                    const GeometryList& b, const ProbabilityRequest& request);

  void drawTo(std::size_t count, double tolerance) override;
  const MeanSequence& samples() const override { return *samples_; }
  void aim(double below, double above) override;
  double offset() const override { return offset_; }
  double mostSamples() const override;
  void describe(ProbabilityResult& result) const override;

 private:
  /// How one component of the mixture is counted.
  struct Counting {
    const RandomConfiguration* configuration;
    std::optional<BoundaryModel> model;  ///< nothing: contacts are counted as they are
    double mass = 0.0;                   ///< of the model
    double as_they_are = 1.0;  ///< share of the samples that is drawn as the density has them
    double variance = 0.25;    ///< of a sample, as far as it is known before there are any
  };

  /// What is added to the mean by one sample.
  struct Counted {
    double value = 0.0;
    bool hit = false;
  };

  bool collidesAt(const RandomConfiguration& configuration, const Eigen::VectorXd& x) const;
  Counting prepared(const ConfigurationMixture::Component& component, std::uint64_t seed);
  double samplesWith(double variance, double weight, double probability) const;
  double chooseShare(Counting& counting) const;
  double bend(BoundarySearch& search, Counting& counting) const;
  Counted countAt(std::size_t index) const;
  Counted countNear(const Counting& counting, const Eigen::VectorXd& normals, double uniform) const;

  const ConfigurationMixture& mixture_;
  const ProbabilityRequest& request_;
  Budget& watch_;
  PlacementCollider collider_;
  std::vector<Counting> countings_;
  std::optional<MeanSequence> samples_;
  double offset_ = 0.0;
  double weight_ = 1.0;  ///< the largest that a sample may have
  std::size_t questions_ = 0;
  std::size_t drawn_ = 0;
  std::size_t hits_ = 0;
};

}  // namespace fcl_prob::detail
