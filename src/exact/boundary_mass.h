// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What the C-obstacle of two convex bodies is bounded by, and its mass from that.
#pragma once

#include "convex/pair_obstacle.h"
#include "mass/moment_gradient.h"
#include "mass/rounded_polytope_mass.h"

namespace fcl_prob::detail {

/// The one classification of pairs of convex bodies: which of the ways to a mass under a
/// displacement of rank 3 serves.
enum class BoundaryKind {
  flat,       ///< a polytope
  ball,       ///< of two balls
  rounded,    ///< a polytope swept by a ball
  ellipsoid,  ///< of an ellipsoid beside a polytope: a linear image of what is rounded
  curved,     ///< smooth patches
  other       ///< known between polytopes only
};

BoundaryKind boundaryKind(const ConvexBody& a, const ConvexBody& b);

/// The masses of polytopes inside and around a curved body differ by about 4 / resolution: what is
/// known better is not looked for any more.
inline constexpr double kSandwichWidth = 1e-4;
bool isNarrowMass(const Bounds& mass);

/// Mass and, if the moment is asked for, gradient under a displacement of rank 3, by quadrature
/// over the boundary; [0, 1] for flat pairs, others, and where rounding spoils it. \throws as
/// pairFrame()
PairMass boundaryMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                      const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                      const RoundedEffort& effort);

}  // namespace fcl_prob::detail
