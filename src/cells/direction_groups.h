// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Vectors sorted by where they point.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace fcl_prob::detail {

/// For every vector the number of its group, of which there are at most `most`: those that point
/// about the same way. Their centers are chosen one after the other, each the vector that is
/// farthest from all before (Gonzalez 1985, which is within twice the least radius).
std::vector<int> groupByDirection(const std::vector<Eigen::Vector3d>& vectors, int most);

}  // namespace fcl_prob::detail
