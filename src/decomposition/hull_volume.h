// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Volumes of convex hulls, for choosing between decompositions.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace fcl_prob::detail {

/// Volume of the convex hull of some points (Qhull), cubic metres; 0 where they have none. It
/// decides between cuts and bounds nothing.
double hullVolume(const std::vector<Eigen::Vector3d>& points);

}  // namespace fcl_prob::detail
