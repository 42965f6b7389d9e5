// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Slabs of the C-obstacle of two convex pieces that are not both triangles.
#pragma once

#include <vector>

#include "scene/whitened_tree.h"

namespace fcl_prob::detail {

struct PieceSlabs {
  std::vector<double> data;  ///< as SlabArrays
  int count = 0;
};

/// One slab per face of either piece and per pair of edges.
PieceSlabs pieceSlabs(const WhitenedPair& pair, NodePair leaves);

}  // namespace fcl_prob::detail
