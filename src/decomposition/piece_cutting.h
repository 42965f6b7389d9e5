// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A mesh cut into pieces that are nearly convex, and put together again.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::detail {

using PointSet = std::vector<Eigen::Vector3d>;

/// Cuts the surface, always where the hulls shrink most, until there are `count` pieces or no cut
/// helps. The hulls of the results, each the hull of some points, cover the mesh up to rounding; if
/// it is closed, also the solid inside.
std::vector<PointSet> cutIntoPieces(const TriangleMesh& mesh, std::size_t count);

/// Unites the two sets whose common hull exceeds their own by the least volume, until there are no
/// more than `count`, and as long as that is at most `excess` (cubic metres).
void unitePieces(std::size_t count, double excess, std::vector<PointSet>& pieces);

/// Which two sets are united after one another until one is left, as unitePieces() does: sets have
/// the numbers of their order, unions those that follow.
std::vector<std::pair<std::size_t, std::size_t>> unionOrder(std::vector<PointSet> pieces);

}  // namespace fcl_prob::detail
