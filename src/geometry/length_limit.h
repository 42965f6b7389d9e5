// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Lengths that can be computed with.
#pragma once

#include <Eigen/Core>

namespace fcl_prob::detail {

/// Metres. As of standard deviations, the square of any is finite.
inline constexpr double kLargestLength = 1e150;

/// Whether all coordinates are numbers of at most that.
inline bool isPosition(const Eigen::Vector3d& point) {
  return (point.array().abs() <= kLargestLength).all();
}

}  // namespace fcl_prob::detail
