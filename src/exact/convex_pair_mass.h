// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The mass and the bounds of a convex pair for a caller who may not have the time.
#pragma once

#include "base/interruption.h"
#include "fcl_prob/convex_pcd.h"

namespace fcl_prob::detail {

/// convexPairMass() until the interruption is due; then what is certain by then.
/// \param inset  metres: by so much the bodies together may stay behind polytopes; no more than
/// what
///   doubles are widened by for rounding
Bounds convexPairMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                      const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                      const Interruption& interruption, double inset = 0.0);

}  // namespace fcl_prob::detail
