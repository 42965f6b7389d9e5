// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The probability of two convex shapes, without any tree.
#pragma once

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"
#include "query/upper_bounds.h"

namespace fcl_prob::detail {

/// What rounding leaves of the mass of a polytope, of itself: nothing makes it narrower.
inline constexpr double kRoundingWidth = 1e-9;

/// The mass of the C-obstacle. Flat sides leave a rounding margin only; curved ones what their
/// quadrature or polygons leave; where that is too much they are enclosed between polytopes, which
/// are refined once if the tolerance asks for it. A limit of the request leaves what is certain by
/// then.
ProbabilityResult exactMass(const PlacedPair& pair, const GaussianDisplacement& displacement,
                            const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
