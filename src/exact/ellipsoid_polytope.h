// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// An ellipsoid beside a polytope: where it is a ball, the polytope is swept by a ball.
#pragma once

#include "convex/pair_obstacle.h"
#include "mass/moment_gradient.h"
#include "mass/rounded_polytope_mass.h"

namespace fcl_prob::detail {

/// Whether one body is an ellipsoid and the other one a polytope.
bool isEllipsoidWithPolytope(const ConvexBody& a, const ConvexBody& b);

/// Mass of such a pair under a displacement of rank 3, with its gradient if the moment is asked
/// for; as roundedPolytopeMass() has it, in the linear image of the world in which the ellipsoid is
/// the unit ball. \throws as pairFrame() does
PairMass ellipsoidPolytopeMass(const ConvexBody& a, const fcl::Transform3d& pose_a,
                               const ConvexBody& b, const fcl::Transform3d& pose_b,
                               const GaussianDisplacement& displacement,
                               const RoundedEffort& effort);

}  // namespace fcl_prob::detail
