// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The plane that divides a piece of a surface into the two smallest convex hulls.
#pragma once

#include "decomposition/solid_cell.h"
#include "decomposition/surface_piece.h"

namespace fcl_prob::detail {

/// What of a mesh is in a convex cell.
struct Piece {
  SurfacePiece surface;
  SolidCell cell;

  bool isEmpty() const { return surface.isEmpty() && cell.cornersInside().empty(); }

  Piece below(const CutPlane& plane, bool keep_coplanar) const {
    return {surface.below(plane, keep_coplanar), cell.below(plane)};
  }
};

struct BestCut {
  CutPlane plane;
  double gain = 0.0;  ///< by how much the hulls shrink in total, cubic metres; 0: no plane helps
};

/// Tries planes through vertices in sixteen directions. Hulls are compared by their extreme points
/// in a fixed set of directions; the gain is that of the hulls themselves. What of the solid is in
/// the cell counts as well as the surface.
BestCut bestCut(const Piece& piece);

/// The plane through the middle of the piece after which one more cut of either side makes the
/// hulls shrink most, among six directions; the gain is that of all three cuts.
BestCut bestFirstOfTwoCuts(const Piece& piece);

}  // namespace fcl_prob::detail
