// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Points without those that rounding alone keeps apart.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace fcl_prob::detail {

/// Leaves out points that are within `distance` of one that stays: hulls of what stays have no
/// faces narrower than that, whose normals would be noise. In quadratic time.
std::vector<Eigen::Vector3d> thinnedOut(const std::vector<Eigen::Vector3d>& points,
                                        double distance);

}  // namespace fcl_prob::detail
