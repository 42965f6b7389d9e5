// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The probabilistic query next to fcl::collide.
#pragma once

#include <fcl/narrowphase/collision_object.h>

#include <memory>

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob {

class GaussianMixture;
class TruncatedGaussian;

/// The probability that `a`, displaced by `displacement` (relative to `b`, world frame, metres),
/// collides with `b`. Fills `result` and returns result.probability(). `result` is assigned only on
/// success. \throws InvalidRequest, InvalidPose, InvalidGeometry, UnsupportedGeometry, OpenMesh
/// before any work.
///
/// Contact is what fcl::collide finds, which leaves out a geometry that is not `isOccupied()`
/// (cost_density >= threshold_occupied; by default all are): then P is 0, and `plan` says why. Of
/// an octree only the cells count, not these fields; a shape or mesh that is also `isFree()`
/// (cost_density <= threshold_free) meets none. Two octrees with a cell both occupied and free are
/// refused by all but Monte Carlo (UnsupportedGeometry).
double collisionProbability(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                            const GaussianDisplacement& displacement,
                            const ProbabilityRequest& request, ProbabilityResult& result);

/// The same for geometries and their poses in the world frame.
double collisionProbability(const fcl::CollisionGeometryd* a, const fcl::Transform3d& pose_a,
                            const fcl::CollisionGeometryd* b, const fcl::Transform3d& pose_b,
                            const GaussianDisplacement& displacement,
                            const ProbabilityRequest& request, ProbabilityResult& result);

/// A pair of geometries prepared once and queried for many poses and displacements: holds
/// everything that depends on neither. Const and thread-safe after construction.
class PreparedQuery {
 public:
  /// Keeps references to both geometries, which must not change while the query lives.
  PreparedQuery(std::shared_ptr<const fcl::CollisionGeometryd> a,
                std::shared_ptr<const fcl::CollisionGeometryd> b);
  ~PreparedQuery();
  PreparedQuery(PreparedQuery&&) noexcept;
  PreparedQuery& operator=(PreparedQuery&&) noexcept;

  double collisionProbability(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                              const GaussianDisplacement& displacement,
                              const ProbabilityRequest& request, ProbabilityResult& result) const;

 private:
  // Declared for callers in fcl_prob/mixture.h.
  friend double collisionProbability(const PreparedQuery& query, const fcl::Transform3d& pose_a,
                                     const fcl::Transform3d& pose_b,
                                     const TruncatedGaussian& displacement,
                                     const ProbabilityRequest& request, ProbabilityResult& result);
  friend double collisionProbability(const PreparedQuery& query, const fcl::Transform3d& pose_a,
                                     const fcl::Transform3d& pose_b,
                                     const GaussianMixture& displacement,
                                     const ProbabilityRequest& request, ProbabilityResult& result);

  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace fcl_prob
