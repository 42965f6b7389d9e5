// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// P(A wholly within B), by two queries of contact.
#pragma once

#include <functional>

#include "query/pair_query.h"

namespace fcl_prob::detail {

/// Where neither object is in several pieces and B is wider than A along some axis, so that it is
/// never within A, A is within B if and only if the solids overlap and their surfaces do not meet:
/// P is the difference of two probabilities of contact. Where they are equally wide along all axes,
/// to rounding, P is no more than that.
class ContainedPair {
 public:
  using Prepared = std::shared_ptr<const PreparedGeometry>;
  using Ask = std::function<ProbabilityResult(const PairQuery& pair, const ProbabilityRequest&)>;

  /// A Box or Convex B counts as the mesh that its faces are.
  /// \throws UnsupportedGeometry for any other B that is no mesh, for an A that is neither a mesh
  /// nor
  ///         convex, and for what is in several pieces; OpenMesh; InvalidPose
  ContainedPair(Prepared a, const fcl::Transform3d& pose_a, Prepared b,
                const fcl::Transform3d& pose_b);

  /// \param ask  answers requests for contact of such a pair, in the same poses
  /// \throws InvalidRequest for a method other than automatic, interval and estimate, and bands
  ProbabilityResult answer(const ProbabilityRequest& request, const Ask& ask) const;

 private:
  Bounds difference(const Bounds& overlap, const Bounds& touch) const;

  Prepared a_, b_;
  bool is_too_large_;    ///< A for B, along some axis: P is 0
  bool holds_no_other_;  ///< B is not within A, whatever the displacement
};

}  // namespace fcl_prob::detail
