// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The direction in which two objects are nearest to touching, in the whitened frame.
#pragma once

#include <Eigen/Core>

#include "scene/whitened_tree.h"

namespace fcl_prob::detail {

/// How long to look for what is nearest.
enum class Care { rough, full };

/// Direction from the mean displacement to the nearest point of the C-obstacle, roughly: only the
/// efficiency of a partition depends on it. Zero if the mean displacement is within the obstacle or
/// no direction stands out.
Eigen::Vector3d closestApproach(const WhitenedPair& pair, int rank, Care care);

}  // namespace fcl_prob::detail
