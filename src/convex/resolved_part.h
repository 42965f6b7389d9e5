// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Displacements of which positions resolve only some axes.
#pragma once

#include "fcl_prob/gaussian_displacement.h"

namespace fcl_prob::detail {

/// A displacement without its least axes, and no less than how far it moves along those, metres.
struct ResolvedPart {
  GaussianDisplacement displacement;
  double left_out = 0.0;
};

/// Leaves out the axes along which all of the displacement is shorter than what rounds the position
/// of a point so far from the origin: ε of `size`. Lengths in such deviations overflow, or tell
/// nothing. Beyond kReach deviations there is no mass in double precision.
ResolvedPart resolvedPart(const GaussianDisplacement& displacement, double size);

}  // namespace fcl_prob::detail
