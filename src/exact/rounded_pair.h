// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Pairs of which the C-obstacle is a polytope swept by a ball: spheres and capsules beside each
// other, beside boxes, triangles and convex polytopes.
#pragma once

#include "convex/pair_obstacle.h"
#include "mass/moment_gradient.h"
#include "mass/rounded_polytope_mass.h"

namespace fcl_prob::detail {

/// Whether at least one body is rounded by a ball, and the other one is or is a polytope.
bool isRoundedPair(const ConvexBody& a, const ConvexBody& b);

/// Mass and, if the moment is asked for, gradient of an isRoundedPair() under rank 3; [0, 1] if
/// rounding spoils the faces. What rounding does to the shapes is counted next to their own size:
/// where they are is known to 2⁻⁶², however far away. \throws as pairFrame() does
PairMass roundedPairMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                         const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                         const RoundedEffort& effort);

}  // namespace fcl_prob::detail
