// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Intersection of a convex polytope with a half-space.
#pragma once

#include "fcl_prob/convex_polytope.h"
#include "fcl_prob/polytope_mass.h"

namespace fcl_prob::detail {

/// The part of the polytope in the half-space; no faces if that has no volume. Vertices that are
/// kept keep their coordinates; one on a cut edge is within a few rounding errors of the edge's
/// length from the edge. Both halves of a cut have the same vertices in the plane of the cut.
ConvexPolytope clipped(const ConvexPolytope& polytope, const HalfSpace& half_space);

}  // namespace fcl_prob::detail
