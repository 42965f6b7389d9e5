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

/// Takes the polytopes off every triangle, one by one, and looks if anything is left. Rounding is
/// on the safe side: each polytope counts as smaller by `margin` (metres), which is more than all
/// cuts can have moved any point by; so neighbours have to overlap by more than that.
/// \returns the first triangle that is not proven to be in the union, if there is one
std::optional<std::size_t> firstUncovered(const TriangleMesh& mesh,
                                          const std::vector<ConvexPolytope>& polytopes,
                                          double margin);

}  // namespace fcl_prob::detail
