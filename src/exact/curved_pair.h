// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Pairs of ellipsoids, cylinders, cones, capsules and spheres, by integrals over their boundary.
#pragma once

#include "base/interruption.h"
#include "convex/pair_obstacle.h"
#include "fcl_prob/bounds.h"
#include "mass/moment_gradient.h"

namespace fcl_prob::detail {

/// Whether curvedPairMass() knows the pair.
bool isCurvedPair(const ConvexBody& a, const ConvexBody& b);

/// Mass of an isCurvedPair() under a displacement of rank 3: relative width 1e-6 or less where the
/// bodies are not far longer than the deviations or flatter than 1e-4, at the worst [0, 1].
/// \throws as pairFrame() does
Bounds curvedPairMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                      const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                      const Interruption& interruption);

/// The same and, if asked for, the gradient: its error is about that of the mass times how far the
/// body is from the mean, in deviations.
PairMass curvedPairMassAndGradient(const ConvexBody& a, const fcl::Transform3d& pose_a,
                                   const ConvexBody& b, const fcl::Transform3d& pose_b,
                                   const GaussianDisplacement& displacement, bool with_gradient,
                                   const Interruption& interruption);

}  // namespace fcl_prob::detail
