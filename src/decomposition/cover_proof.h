// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Whether convex polytopes cover the triangles of a mesh.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fcl_prob/convex_polytope.h"
#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::detail {

/// By how much less a polytope counts than it is, metres; neighbours have to overlap by more.
struct CoverMargins {
  double rounding;  ///< more than what all cuts can have moved any point by
  double depth;     ///< what is proven is that every point is this far inside some polytope
};

/// Takes the polytopes off every triangle, one by one, and looks if anything is left. Rounding is
/// on the safe side.
/// \returns the first triangle that is not proven to be in the union, if there is one
std::optional<std::size_t> firstUncovered(const TriangleMesh& mesh,
                                          const std::vector<ConvexPolytope>& polytopes,
                                          CoverMargins margins);

}  // namespace fcl_prob::detail
