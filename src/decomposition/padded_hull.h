// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex hulls that are larger than rounding can make them smaller.
#pragma once

#include "fcl_prob/convex_polytope.h"

namespace fcl_prob::detail {

/// A polytope with faces that contains every point within `padding` (metres) of a hull, and hardly
/// more: the hull scaled about its middle, or, where it is too thin for that, the hull of an
/// octahedron around each of its corners.
ConvexPolytope paddedHull(ConvexPolytope hull, double padding);

}  // namespace fcl_prob::detail
