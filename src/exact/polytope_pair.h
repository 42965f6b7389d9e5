// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Pairs of convex polytopes with every rounding counted on the way to their mass.
#pragma once

#include <optional>

#include "base/interruption.h"
#include "convex/pair_obstacle.h"
#include "mass/moment_gradient.h"

namespace fcl_prob::detail {

/// Mass of the C-obstacle of two polytopes under a displacement of rank 3. The corners of boxes,
/// triangles and FCL's Convex are taken as they are; of bounding volumes, which may miss their own
/// contents, this says nothing. Unlike PairBounds::mass(), which widens by a number of roundings
/// that is never exceeded, corners are sums of long doubles, and how far the true body reaches out
/// of the faces found is measured: relative width 1e-10 or less from P = 1 to 1e-300 and for sizes
/// from 1e-3 to 1e3 deviations. Nothing, if the body is flat or its faces are not all seen from
/// its middle.
/// \param inset  metres: by so much the bodies together may stay behind the polytopes
/// \throws as pairFrame() does
std::optional<PairMass> polytopePairMass(const ConvexBody& a, const fcl::Transform3d& pose_a,
                                         const ConvexBody& b, const fcl::Transform3d& pose_b,
                                         const GaussianDisplacement& displacement,
                                         bool with_gradient, const Interruption& interruption,
                                         double inset = 0.0);

}  // namespace fcl_prob::detail
