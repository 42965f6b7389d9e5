// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The probability of collision under errors of poses and joints, not of positions only.
#pragma once

#include "fcl_prob/collision_probability.h"
#include "fcl_prob/group.h"
#include "fcl_prob/pose_error.h"
#include "fcl_prob/random_configuration.h"

namespace fcl_prob {

/// The probability that `a`, at `pose_a` up to `error`, collides with `b`. Fills `result`, which is
/// assigned only on success, and returns result.probability().
///
/// Given the rotation, what is left is a Gaussian translation, which a PreparedQuery answers; the
/// answers are combined over rotations. request.method is one of
/// - `automatic`, `estimate`: rotations in antithetic pairs with a quadratic control variate, or
///   calls of fcl::collide at evenly spread points in all dimensions (randomised quasi-Monte
///   Carlo), whichever promises to end sooner, until the standard error is within the tolerance;
///   `confidence_interval` and a threshold go by Student's t. The plan says which it was. The
///   certified interval given is [0, 1]. request.max_cells limits the cells of all rotations
///   together (16 samples count as one), time_limit all of them. With a gradient: pairs only.
/// - `interval`: certified. Rotations are divided into cells; in each the shift that a rotation
/// means
///   about a point near the contact joins the translation, and what is left moves the pieces. No
///   gradient. \throws UnsupportedGeometry beside a Halfspace or Plane
/// - `rare_event`: as `estimate`, but what is left given a rotation is counted by fcl::collide at
///   importance samples, request.samples of them a rotation at most: independent of the partition.
/// - `monte_carlo`: fcl::collide at poses displaced in all six dimensions.
/// The seed fixes all samples, whatever the number of threads. The gradient is that of moving the
/// mean of A (world frame). If the rotation does not vary, every method is that for the translation
/// alone, with the same result.
///
/// \throws InvalidRequest, InvalidPose, InvalidGeometry, OpenMesh before any work;
/// UnsupportedGeometry also for any other method, if the rotation varies
double collisionProbability(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                            const PoseError& error, const ProbabilityRequest& request,
                            ProbabilityResult& result);

/// The same for geometries and their poses in the world frame.
double collisionProbability(const fcl::CollisionGeometryd* a, const fcl::Transform3d& pose_a,
                            const fcl::CollisionGeometryd* b, const fcl::Transform3d& pose_b,
                            const PoseError& error, const ProbabilityRequest& request,
                            ProbabilityResult& result);

/// A pair of geometries prepared once, for many poses and errors. Const and thread-safe.
class PreparedPoseQuery {
 public:
  /// Keeps references to both geometries, which must not change while the query lives.
  PreparedPoseQuery(std::shared_ptr<const fcl::CollisionGeometryd> a,
                    std::shared_ptr<const fcl::CollisionGeometryd> b);
  ~PreparedPoseQuery();
  PreparedPoseQuery(PreparedPoseQuery&&) noexcept;
  PreparedPoseQuery& operator=(PreparedPoseQuery&&) noexcept;

  double collisionProbability(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                              const PoseError& error, const ProbabilityRequest& request,
                              ProbabilityResult& result) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Two groups at a random configuration: links whose joints have errors, bodies with pose errors, a
/// base that is localised badly. The same methods as for one pose error, with the configuration in
/// place of the rotation.
class ConfigurationQuery {
 public:
  /// \throws as GroupQuery
  ConfigurationQuery(GroupQuery::Geometries group_a, GroupQuery::Geometries group_b);
  ~ConfigurationQuery();
  ConfigurationQuery(ConfigurationQuery&&) noexcept;
  ConfigurationQuery& operator=(ConfigurationQuery&&) noexcept;

  /// The probability that any member of A collides with any member of B. \throws as GroupQuery;
  /// what configuration.at() throws
  double collisionProbability(const RandomConfiguration& configuration,
                              const ProbabilityRequest& request, ProbabilityResult& result) const;

  /// The same for one of several configurations, each with its probability (a mixture).
  /// \throws InvalidDistribution if the weights are negative, not finite, or do not add up to 1 to
  /// 1e-9
  struct Weighted {
    double weight;
    std::shared_ptr<const RandomConfiguration> configuration;
  };
  double collisionProbability(const std::vector<Weighted>& mixture,
                              const ProbabilityRequest& request, ProbabilityResult& result) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace fcl_prob
