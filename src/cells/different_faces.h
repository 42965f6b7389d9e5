// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A few faces of a convex mesh that tell the most of where it ends.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "scene/whitened_fan.h"

namespace fcl_prob::detail {

/// So many of the candidates, or fewer, whose normals are as different as possible, the first of
/// them nearest to `along`; none that is nearly parallel to one before.
std::vector<int> differentFaces(const WhitenedFan& fan, const std::vector<int>& candidates,
                                const Eigen::Vector3d& along, int count);

}  // namespace fcl_prob::detail
