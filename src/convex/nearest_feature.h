// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Which corner, edge or face of a hull of points is nearest to a point: a guess.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace fcl_prob::detail {

/// A corner, an edge or a face by as many of the points.
struct NearestFeature {
  std::array<int, 3> points{};
  int count = 0;  ///< 0: the point is within the hull, as far as can be seen
  Eigen::Vector3d nearest = Eigen::Vector3d::Zero();
  double distance = 0.0;
};

/// By Gilbert's algorithm, up to rounding: what it says is to be checked. (E. G. Gilbert, D. W.
/// Johnson, S. S. Keerthi, A fast procedure for computing the distance between complex objects,
/// IEEE J. Robotics and Automation 4, 1988.)
NearestFeature nearestFeature(const std::vector<Eigen::Vector3d>& points,
                              const Eigen::Vector3d& from);

}  // namespace fcl_prob::detail
