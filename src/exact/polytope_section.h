// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Two convex polytopes that move in a plane or along a line.
#pragma once

#include "base/interruption.h"
#include "fcl_prob/bounds.h"
#include "fcl_prob/convex_body.h"
#include "fcl_prob/gaussian_displacement.h"

namespace fcl_prob::detail {

/// Certified mass of the C-obstacle V of two polytopes under a displacement of rank 2: that of its
/// section with the plane of motion; of rank 1: with a line in such a plane. Edges of V are cut
/// with it in long doubles. The polygon through the cuts has its corners in V, whatever edges were
/// found, but for what they are rounded by; how far V reaches beyond each of its sides is measured,
/// by the support function of V along the normal of a face through that side. So what is off is a
/// layer along the sides. Nothing, [0, 1], where V hardly reaches through the plane.
/// \param inset  metres: by so much the bodies together may stay behind the polytopes
/// \throws as pairFrame() does
Bounds polytopeSectionMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                           const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                           const Interruption& interruption, double inset = 0.0);

}  // namespace fcl_prob::detail
