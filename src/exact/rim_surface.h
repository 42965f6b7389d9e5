// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The boundary of the sum of a polytope and a frustum, as patches.
#pragma once

#include <optional>

#include "exact/curved_surface.h"

namespace fcl_prob::detail {

/// Patches, and how far what they enclose may be from the sum besides rounding (frame of the
/// frustum, as a share of nothing: metres).
struct RimSurface {
  std::vector<SurfacePatch> patches;
  double defect = 0.0;
};

/// The boundary of `polytope` ⊕ frustum, the polytope in the frustum's frame; sum.ellipsoids is
/// empty. The normals of the polytope's edges are arcs on the sphere of normals, which the circle
/// of the normals of the frustum's side cuts: off the circle an edge is swept along the rim, on it
/// along a segment of the side (a parallelogram), and between two cuts a corner is swept by the
/// side; faces are moved to where the rim is along their normal, and both discs to the highest and
/// lowest corner. Cuts and normals are rounded, but patches that meet share them. That the surface
/// closes is checked: corners along the circle follow each other, and around each corner the rim
/// turns once (where the axis leaves its normals) or not at all.
///
/// \return nothing where the surface does not close, as where a normal is along the axis or the
/// circle
std::optional<RimSurface> rimSurface(const CurvedSum& sum, const ConvexMesh& polytope);

}  // namespace fcl_prob::detail
