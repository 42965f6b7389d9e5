// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The C-obstacle of two convex bodies along the principal axes of their displacement.
#pragma once

#include <optional>

#include "convex/pair_frame.h"
#include "convex/support_shape.h"
#include "fcl_prob/convex_body.h"
#include "mass/rounded_parts.h"

namespace fcl_prob::detail {

/// A ball within a convex body.
struct BallWithin {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0.0;  ///< may be 0
};

/// B ⊕ (−A) about the difference of the bodies' origins, seen along principal axes in a unit next
/// to the size, by its support function.
class PrincipalObstacle {
 public:
  PrincipalObstacle(const PairFrame& frame, const ConvexBody& a, const fcl::Transform3d& pose_a,
                    const ConvexBody& b, const fcl::Transform3d& pose_b,
                    const GaussianDisplacement& displacement);

  /// A point that is farthest along a direction (any length).
  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const {
    return b_.supportPoint(direction) - a_.supportPoint(-direction);
  }

  /// No support point is farther from the obstacle than that, and the obstacle reaches no farther
  /// beyond a support point than that, along the direction.
  double error() const { return error_; }

  /// Rounding that answers to a length of the obstacle's own size.
  double resolution() const { return resolution_; }

  /// Where the obstacle is: the mean of the displacement is at minus this.
  const LongVector3& offset() const { return offset_; }

  /// Along the principal axes, in the unit; 0 where nothing moves.
  const LongVector3& deviations() const { return deviations_; }

  /// About the same origin as support points. Of radius 0 only if both bodies are polytopes or
  /// rounding spoils it.
  const BallWithin& ball() const { return ball_; }

 private:
  SupportShape a_, b_;
  double error_, resolution_;
  LongVector3 offset_, deviations_;
  BallWithin ball_;
};

}  // namespace fcl_prob::detail
