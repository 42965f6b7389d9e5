// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The points of a convex body that lie farthest in a direction, all of them.
#pragma once

#include <Eigen/Core>

namespace fcl_prob::detail {

/// The flat side, edge or corner of a body that faces a direction: `middle` plus a combination of
/// the columns of `spanning`, none for a corner.
struct TouchingFace {
  Eigen::Vector3d middle;
  Eigen::Matrix<double, 3, Eigen::Dynamic> spanning;

  /// Around the middle of some points.
  static TouchingFace around(const Eigen::Matrix<double, 3, Eigen::Dynamic>& points);
};

/// The point of the first face that is at `offset` from one of the second: with offset + first =
/// second as nearly as can be, and nearest to the middles where many are.
Eigen::Vector3d touchingPoint(const TouchingFace& first, const TouchingFace& second,
                              const Eigen::Vector3d& offset);

}  // namespace fcl_prob::detail
