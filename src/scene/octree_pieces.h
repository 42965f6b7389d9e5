// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// An octree as a binary tree over boxes.
#pragma once

#include <fcl/geometry/octree/octree.h>

#include "scene/piece_tree.h"

namespace fcl_prob::detail {

/// Fills an empty tree with one box for every cell that fcl::collide takes as occupied: the
/// occupied leaves whose ancestors are all occupied and not free. Eight of them that fill their
/// parent are one box. Leaves `tree.nodes` empty if there are none.
///
/// \return by how much (metres) the boxes may differ from those that FCL computes: it halves those
///         of parents, and the larger they are the more that rounds.
double fillOcTree(const fcl::OcTreed& octree, PieceTree& tree);

}  // namespace fcl_prob::detail
