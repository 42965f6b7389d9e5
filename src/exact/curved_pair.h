// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Pairs of ellipsoids, cylinders, cones, capsules and spheres, by integrals over their boundary.
#pragma once

#include "convex/pair_obstacle.h"
#include "mass/moment_gradient.h"
#include "mass/rounded_polytope_mass.h"

namespace fcl_prob::detail {

/// Whether curvedPairMass() knows the pair.
bool isCurvedPair(const ConvexBody& a, const ConvexBody& b);

/// Mass of an isCurvedPair() under a displacement of rank 3: relative width 1e-6 or less where the
/// bodies are not far longer than the deviations or flatter than 1e-4, at the worst [0, 1]. With
/// the moment its gradient, whose error is about that of the mass times how far the body is from
/// the mean, in deviations. \throws as pairFrame() does
PairMass curvedPairMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                        const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                        const RoundedEffort& effort);

}  // namespace fcl_prob::detail
