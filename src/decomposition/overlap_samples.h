// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Estimates of what C-obstacles have in common, to choose which intersections are worth computing.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "decomposition/intersection_mass.h"

namespace fcl_prob::detail {

/// Estimated mass of every intersection of two obstacles, from a fixed set of points around
/// `centre` (whitened); 0 where one of the two is not known. Symmetric.
std::vector<std::vector<double>> sampledOverlaps(
    const std::vector<std::optional<KnownObstacle>>& obstacles, const Eigen::Vector3d& centre);

/// The edges of a spanning tree of the largest weight (Prim), larger weights nearer to the first
/// node; an edge for every node but the first.
std::vector<std::pair<std::size_t, std::size_t>> heaviestTree(
    const std::vector<std::vector<double>>& weights);

}  // namespace fcl_prob::detail
