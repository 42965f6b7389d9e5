// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Intersection of a convex polytope with a half-space.
#pragma once

#include "fcl_prob/convex_polytope.h"
#include "fcl_prob/polytope_mass.h"

namespace fcl_prob::detail {

/// The half-space { y : normal·y >= offset }; |normal| = 1.
struct HalfSpace {
  Eigen::Vector3d normal;
  double offset;
};

/// Vertices within this of the plane, in units of the largest distance from the origin of a vertex
/// or of the plane, count as on it: twice the rounding of their distance.
inline constexpr double kClipTolerance = 4 * 2.220446049250313e-16;

/// The part of the polytope in the half-space; no faces if that has no volume. Vertices that are
/// kept keep their coordinates. A vertex on a cut edge is as near to the plane, and within two ulp
/// of its largest coordinate on the edge. Both halves of a cut have the same vertices in the plane
/// of the cut.
ConvexPolytope clipped(const ConvexPolytope& polytope, const HalfSpace& half_space);

}  // namespace fcl_prob::detail
