// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Whether convex polytopes cover the solid that a closed mesh encloses.
#pragma once

#include <vector>

#include "decomposition/cover_proof.h"
#include "geometry/closed_mesh.h"

namespace fcl_prob::detail {

/// Takes the polytopes off the box around the mesh, one by one. What is left has no point of the
/// surface (firstUncovered() with these margins has to have proven that), so that it is inside or
/// outside as a whole, which one of its points tells. Rounding is on the safe side.
/// \returns false where the proof fails: a rest is inside, or there are too many of them
bool solidIsCovered(const TriangleMesh& mesh, const ClosedMesh& solid,
                    const std::vector<ConvexPolytope>& polytopes, CoverMargins margins);

}  // namespace fcl_prob::detail
