// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Any two convex bodies, at least one of them curved, that move in a plane or along a line.
#pragma once

#include "base/interruption.h"
#include "convex/pair_obstacle.h"
#include "fcl_prob/bounds.h"

namespace fcl_prob::detail {

/// Mass of a pair that are not both polytopes under a displacement of rank 1 or 2, by support
/// values and support points of its section: relative width about 1e-6 (rank 2) or what rounding of
/// the sizes leaves (rank 1); at the worst [0, 1]. \throws as pairFrame() does
Bounds sectionMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                   const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                   const Interruption& interruption);

}  // namespace fcl_prob::detail
