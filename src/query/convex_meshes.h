// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The probability of two convex meshes, without their triangles.
#pragma once

#include <optional>

#include "query/upper_bounds.h"

namespace fcl_prob::detail {

/// Of two solids, or surfaces, that are convex to rounding: the mass of their C-obstacle less, of
/// surfaces, that of the displacements at which one is within the other. Nothing if one of them is
/// not.
std::optional<ProbabilityResult> convexMeshesMass(const PlacedPair& pair,
                                                  const GaussianDisplacement& displacement,
                                                  const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
