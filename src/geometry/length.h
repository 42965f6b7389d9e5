// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Lengths of vectors at any scale.
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace fcl_prob::detail {

/// The length of `v`; of one so short that its squares underflow its largest coordinate, not 0.
inline double lengthOf(const Eigen::Vector3d& v) {
  return std::max(v.norm(), v.cwiseAbs().maxCoeff());
}

/// Metres. As of standard deviations, the square of any is finite.
inline constexpr double kLargestLength = 1e150;

/// Whether all coordinates are numbers of at most that.
inline bool isPosition(const Eigen::Vector3d& point) {
  return (point.array().abs() <= kLargestLength).all();
}

}  // namespace fcl_prob::detail
