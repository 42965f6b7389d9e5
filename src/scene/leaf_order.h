// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A mesh in memory as its tree visits it.
#pragma once

#include "scene/piece_tree.h"

namespace fcl_prob::detail {

/// Numbers the triangles of a mesh as its leaves come, the left child's first, and the vertices as
/// these triangles need them, those of no triangle last: what is near in the tree is near in
/// memory, and the triangles of a node follow each other. Nodes of few triangles come last. Of a
/// tree of one part.
void orderByLeaves(PieceTree& mesh);

/// Tells every node of one or more meshes in such an order which triangles it has.
void tellTriangles(PieceTree& meshes);

}  // namespace fcl_prob::detail
