// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// One of the two objects of a query, placed in the world.
#pragma once

#include <fcl/common/types.h>

#include <vector>

#include "geometry/closed_mesh.h"
#include "partition/piece_tree.h"
#include "partition/point_motion.h"

namespace fcl_prob::detail {

struct PlacedPart {
  fcl::Transform3d pose;  ///< world frame, metres

  /// The closed mesh that the part is; null for a mesh that counts as a surface and for a convex
  /// shape, whose C-obstacles are solid by themselves.
  const ClosedMesh* solid;
};

/// A geometry, or a group of them that is displaced as one.
struct PartitionObject {
  const PieceTree* tree;
  std::vector<PlacedPart> parts;  ///< as many as tree->parts

  /// Null: it is where the poses say. Otherwise what is settled holds for all motions in the set;
  /// no estimate may then be asked for.
  const PointMotion* motion = nullptr;
};

}  // namespace fcl_prob::detail
