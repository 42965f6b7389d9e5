// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Displacements that are not normal: mixtures of Gaussians, and Gaussians cut off at an ellipsoid.
#pragma once

#include <variant>
#include <vector>

#include "fcl_prob/collision_probability.h"
#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/group.h"

namespace fcl_prob {

/// A displacement that follows one of several Gaussians, each with its probability. Immutable.
class GaussianMixture {
 public:
  struct Component {
    double weight;
    GaussianDisplacement displacement;  ///< of A relative to B, world frame, metres
  };

  /// Weights are divided by their sum, which must be 1 to 1e-9.
  /// \throws InvalidDistribution if there is no component, a weight is negative or not finite, or
  /// they do not add up to 1
  explicit GaussianMixture(std::vector<Component> components);

  const std::vector<Component>& components() const { return components_; }

 private:
  std::vector<Component> components_;
};

/// A Gaussian displacement that is known to stay within its ellipsoid of `deviations` standard
/// deviations: the distribution of `gaussian` given that its Mahalanobis distance from the mean is
/// at most that. Along a direction of variance zero it does not move. Immutable.
class TruncatedGaussian {
 public:
  /// \throws InvalidDistribution if `deviations` is not positive (it may be infinite)
  TruncatedGaussian(const GaussianDisplacement& gaussian, double deviations);

  const GaussianDisplacement& gaussian() const { return gaussian_; }
  double deviations() const { return deviations_; }

 private:
  GaussianDisplacement gaussian_;
  double deviations_;
};

/// Any kind of displacement.
using Displacement = std::variant<GaussianDisplacement, GaussianMixture, TruncatedGaussian>;

/// The probability that A, displaced by a mixture, collides with B: the weighted sum of those of
/// its components, whose intervals carry through. The tolerance is that of the sum; components that
/// matter little are answered coarsely, and a threshold may be decided by some of them. Limits are
/// those of the whole call too, shared evenly by what is left to be done (memory is that of one
/// component at a time); of a component that was not reached nothing is known. The estimate and the
/// gradient are weighted sums; the gradient is that of moving all components alike. Monte Carlo
/// samples the mixture itself; rare_event samples each component (one sample at least), and its
/// confidence interval is the sum of theirs, with their error probabilities adding up to that of
/// the whole. result.status is `converged`, `decided` or `exact`, or says which limit came first;
/// statistics are sums over all that was asked (peaks: maxima).
/// \throws as PreparedQuery::collisionProbability()
double collisionProbability(const PreparedQuery& query, const fcl::Transform3d& pose_a,
                            const fcl::Transform3d& pose_b, const GaussianMixture& displacement,
                            const ProbabilityRequest& request, ProbabilityResult& result);

/// The same for a truncated Gaussian: certified, by a partition of the ellipsoid. Absolute
/// tolerance and threshold are those of the conditional probability. Two unbounded shapes are
/// enclosed by the mass outside the ellipsoid only: their interval may be wider than asked for.
/// \throws as PreparedQuery::collisionProbability(); UnsupportedGeometry if request.method is
/// neither automatic nor interval, InvalidRequest if a gradient is asked for
double collisionProbability(const PreparedQuery& query, const fcl::Transform3d& pose_a,
                            const fcl::Transform3d& pose_b, const TruncatedGaussian& displacement,
                            const ProbabilityRequest& request, ProbabilityResult& result);

/// The same for groups (fcl_prob/group.h), by their partition. \throws as
/// GroupQuery::collisionProbability(), and as above
double collisionProbability(const GroupQuery& query, const std::vector<fcl::Transform3d>& poses_a,
                            const std::vector<fcl::Transform3d>& poses_b,
                            const GaussianMixture& displacement, const ProbabilityRequest& request,
                            ProbabilityResult& result);
double collisionProbability(const GroupQuery& query, const std::vector<fcl::Transform3d>& poses_a,
                            const std::vector<fcl::Transform3d>& poses_b,
                            const TruncatedGaussian& displacement,
                            const ProbabilityRequest& request, ProbabilityResult& result);

/// The same for collision objects, as single queries.
double collisionProbability(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                            const GaussianMixture& displacement, const ProbabilityRequest& request,
                            ProbabilityResult& result);
double collisionProbability(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                            const TruncatedGaussian& displacement,
                            const ProbabilityRequest& request, ProbabilityResult& result);

}  // namespace fcl_prob
