// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Two groups of prepared geometries, queried.
#pragma once

#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fcl_prob/mixture.h"
#include "fcl_prob/motion_gradient.h"
#include "query/member_group.h"
#include "query/pair_query.h"

namespace fcl_prob::detail {

/// What a GroupQuery does. The geometries are shared, so that a body of many groups is prepared
/// once: where trees and proofs are known, making one takes microseconds.
class GroupsQuery {
 public:
  using Poses = std::vector<fcl::Transform3d>;

  /// \param name_a, name_b  how messages and certificates call them
  /// \param about_a         see MemberGroup
  /// \throws as GroupQuery
  GroupsQuery(PreparedGeometries group_a, PreparedGeometries group_b,
              const std::string& name_a = "group A", const std::string& name_b = "group B",
              Poses about_a = {});

  /// \throws what GroupQuery::collisionProbability() does, before any work
  ProbabilityResult answer(const Poses& poses_a, const Poses& poses_b,
                           const GaussianDisplacement& displacement,
                           const ProbabilityRequest& request) const;
  ProbabilityResult answer(const Poses& poses_a, const Poses& poses_b,
                           const GaussianMixture& displacement,
                           const ProbabilityRequest& request) const;
  ProbabilityResult answer(const Poses& poses_a, const Poses& poses_b,
                           const TruncatedGaussian& displacement,
                           const ProbabilityRequest& request) const;

  /// An interval and its certificate. \throws what certifiedProbability() does
  ProbabilityResult certified(const Poses& poses_a, const Poses& poses_b,
                              const GaussianDisplacement& displacement,
                              const ProbabilityRequest& request, std::ostream& certificate) const;

  /// \throws what GroupQuery::motionGradient() does, before any work
  MotionGradient gradient(const Poses& poses_a, const Poses& poses_b,
                          const GaussianDisplacement& displacement,
                          const MemberVelocities& velocities,
                          const MotionGradientRequest& request) const;

 private:
  void validate(const Poses& poses_a, const Poses& poses_b,
                const ProbabilityRequest& request) const;
  ProbabilityResult answerOfGaussian(const Poses& poses_a, const Poses& poses_b,
                                     const GaussianDisplacement& displacement,
                                     const ProbabilityRequest& request,
                                     const BallTruncation* ball = nullptr) const;
  std::string note() const;

  MemberGroup a_;
  MemberGroup b_;
  std::optional<PairQuery> single_;  ///< if both groups have one member
};

}  // namespace fcl_prob::detail
