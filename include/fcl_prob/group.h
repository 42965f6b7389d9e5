// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The probability that any of several objects that share one displacement collides.
#pragma once

#include <iosfwd>
#include <memory>
#include <vector>

#include "fcl_prob/collision_probability.h"
#include "fcl_prob/motion_gradient.h"

namespace fcl_prob {

class GaussianMixture;
class TruncatedGaussian;

/// Two groups of geometries, prepared once: the links of an arm against an obstacle, or an obstacle
/// made of parts. All members of A are displaced by the same random translation relative to all
/// members of B, so that P(any contact) is neither a sum nor a product over the pairs: one
/// partition works on the union of their C-obstacles. (Obstacles whose displacements are
/// independent: anyOfIndependent(); mixtures and truncated displacements: fcl_prob/mixture.h.)
///
/// Const and thread-safe after construction.
class GroupQuery {
 public:
  using Geometries = std::vector<std::shared_ptr<const fcl::CollisionGeometryd>>;

  /// Keeps references to the geometries, which must not change while the query lives. A Halfspace
  /// or Plane may be in one of the groups. Members that are not occupied are left out.
  /// \throws InvalidGeometry, UnsupportedGeometry; InvalidGeometry also for a group without
  /// members,
  ///         UnsupportedGeometry for a member both occupied and free where the other group has an
  ///         octree, which alone would leave it out
  GroupQuery(const Geometries& group_a, const Geometries& group_b);
  ~GroupQuery();
  GroupQuery(GroupQuery&&) noexcept;
  GroupQuery& operator=(GroupQuery&&) noexcept;

  /// The probability that any member of A, displaced by `displacement` (relative to B, world frame,
  /// metres), collides with any member of B. One pose a member, world frame, metres. As
  /// PreparedQuery::collisionProbability() otherwise, which answers if both groups have one member.
  /// \throws InvalidRequest, InvalidPose, OpenMesh; InvalidRequest also if the number of poses is
  /// not that of the members; UnsupportedGeometry if request.method is none of automatic, interval
  /// and estimate, or both groups have unbounded members
  double collisionProbability(const std::vector<fcl::Transform3d>& poses_a,
                              const std::vector<fcl::Transform3d>& poses_b,
                              const GaussianDisplacement& displacement,
                              const ProbabilityRequest& request, ProbabilityResult& result) const;

  /// The same as a certified interval that somebody else can check: see fcl_prob/certificate.h.
  double certifiedProbability(const std::vector<fcl::Transform3d>& poses_a,
                              const std::vector<fcl::Transform3d>& poses_b,
                              const GaussianDisplacement& displacement,
                              const ProbabilityRequest& request, std::ostream& certificate,
                              ProbabilityResult& result) const;

  /// How P changes as the members of A move, each by itself: an estimate, see MotionGradient.
  /// \param velocities  of the members of A: see MemberVelocities, rigidMotions()
  /// \throws InvalidRequest for a displacement of rank 0, velocities that are not one a member, of
  ///         one width or finite, or a request without lines; InvalidPose, OpenMesh
  MotionGradient motionGradient(const std::vector<fcl::Transform3d>& poses_a,
                                const std::vector<fcl::Transform3d>& poses_b,
                                const GaussianDisplacement& displacement,
                                const MemberVelocities& velocities,
                                const MotionGradientRequest& request = {}) const;

 private:
  // Declared for callers in fcl_prob/mixture.h.
  friend double collisionProbability(const GroupQuery& query,
                                     const std::vector<fcl::Transform3d>& poses_a,
                                     const std::vector<fcl::Transform3d>& poses_b,
                                     const GaussianMixture& displacement,
                                     const ProbabilityRequest& request, ProbabilityResult& result);
  friend double collisionProbability(const GroupQuery& query,
                                     const std::vector<fcl::Transform3d>& poses_a,
                                     const std::vector<fcl::Transform3d>& poses_b,
                                     const TruncatedGaussian& displacement,
                                     const ProbabilityRequest& request, ProbabilityResult& result);

  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The same for collision objects, as a single query.
double collisionProbability(const std::vector<const fcl::CollisionObjectd*>& group_a,
                            const std::vector<const fcl::CollisionObjectd*>& group_b,
                            const GaussianDisplacement& displacement,
                            const ProbabilityRequest& request, ProbabilityResult& result);

}  // namespace fcl_prob
