// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The plane that divides a piece of a surface into the two smallest convex hulls.
#pragma once

#include "decomposition/surface_piece.h"

namespace fcl_prob::detail {

struct BestCut {
  CutPlane plane;
  double gain = 0.0;  ///< by how much the hulls shrink in total, cubic metres; 0: no plane helps
};

/// Tries planes through vertices in sixteen directions. Hulls are compared by their extreme points
/// in a fixed set of directions, so that the gain is an estimate.
BestCut bestCut(const SurfacePiece& piece);

}  // namespace fcl_prob::detail
