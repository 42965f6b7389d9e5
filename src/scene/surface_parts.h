// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What of an object hangs together.
#pragma once

#include <vector>

#include "scene/whitened_tree.h"

namespace fcl_prob::detail {

/// A set that is connected: of a mesh a part of the surface, else a convex piece.
struct SurfacePart {
  std::size_t part;       ///< of the object
  Eigen::Vector3d point;  ///< one of it, metres, relative to the origin of that part
  NodeBox box;            ///< around it, whitened, padded as those of nodes
};

/// All parts of an object's surfaces.
std::vector<SurfacePart> surfaceParts(const PartitionObject& object, const WhitenedTree& whitened);

}  // namespace fcl_prob::detail
