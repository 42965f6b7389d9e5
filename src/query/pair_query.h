// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Two prepared geometries, queried.
#pragma once

#include <memory>

#include "fcl_prob/mixture.h"
#include "query/query_plan.h"
#include "query/upper_bounds.h"

namespace fcl_prob::detail {

/// What a PreparedQuery does. The geometries are shared, so that an object of many pairs is
/// prepared once.
class PairQuery {
 public:
  PairQuery(std::shared_ptr<const PreparedGeometry> a, std::shared_ptr<const PreparedGeometry> b)
      : a_(std::move(a)), b_(std::move(b)) {}

  /// \throws what PreparedQuery::collisionProbability() does, before any work.
  ProbabilityResult answer(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                           const GaussianDisplacement& displacement,
                           const ProbabilityRequest& request) const;

  /// The same for a displacement that stays within an ellipsoid.
  ProbabilityResult answer(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                           const TruncatedGaussian& displacement,
                           const ProbabilityRequest& request) const;

  /// The same for a mixture.
  ProbabilityResult answer(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                           const GaussianMixture& displacement,
                           const ProbabilityRequest& request) const;

 private:
  ProbabilityResult answerOfGaussian(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                                     const GaussianDisplacement& displacement,
                                     const ProbabilityRequest& request) const;

  /// By contact = solid and fcl of the same pair, of the same displacement.
  ProbabilityResult answerContained(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                                    const Displacement& displacement,
                                    const ProbabilityRequest& request) const;

  std::shared_ptr<const PreparedGeometry> a_;
  std::shared_ptr<const PreparedGeometry> b_;
};

}  // namespace fcl_prob::detail
