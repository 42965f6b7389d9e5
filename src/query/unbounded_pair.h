// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Pairs with a Halfspace or a Plane, in closed form.
#pragma once

#include "query/upper_bounds.h"

namespace fcl_prob::detail {

/// The exact probability, between bounds that differ by rounding: whether a Halfspace or a Plane
/// touches anything depends only on how far the displacement reaches along its normal, which is a
/// normal variable. A Halfspace is solid; a Plane is a surface, as is a mesh, so that a mesh
/// between whose parts the plane fits does not collide there.
///
/// Two of them that are not parallel always meet. FCL's own test for parallel normals is used, but
/// not its answer for half-spaces that face each other, which has the wrong sign. \throws OpenMesh
ProbabilityResult unboundedPairProbability(const PlacedPair& pair,
                                           const GaussianDisplacement& displacement,
                                           const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
