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

}  // namespace fcl_prob::detail
