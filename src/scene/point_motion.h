// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How far the points of an object may be from where its pose puts them.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace fcl_prob::detail {

/// A set of motions of a rigid object, world frame, metres: a point x of it moves by
/// Σ a_j turns_j × (x - centre) + Σ b_l shifts_l + r with |a_j|, |b_l| <= 1 and
/// |r| <= remainder |x - centre| + ball. What is certain of an object with such a set is certain
/// for each motion in it.
struct PointMotion {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> turns;
  std::vector<Eigen::Vector3d> shifts;
  double remainder = 0.0;
  double ball = 0.0;

  /// Bound on how far the point moves along each axis of the frame that `whitening` maps to. Convex
  /// in `x`: over a polytope it is largest at a vertex.
  Eigen::Vector3d bound(const Eigen::Matrix3d& whitening, const Eigen::Vector3d& x) const;

  /// Bound on n·d over the displacements d of the point. Convex in `x`; in `n` the support function
  /// of a set. \param n  world frame, any length
  double along(const Eigen::Vector3d& n, const Eigen::Vector3d& x) const;

  /// How far points move that are no farther than `radius` from the centre, up to the rounding of
  /// its sums.
  double reach(double radius) const;
};

}  // namespace fcl_prob::detail
