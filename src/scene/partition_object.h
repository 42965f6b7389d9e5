// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// One of the two objects of a query, placed in the world.
#pragma once

#include <fcl/common/types.h>

#include <algorithm>
#include <vector>

#include "geometry/closed_mesh.h"
#include "scene/piece_tree.h"
#include "scene/point_motion.h"

namespace fcl_prob::detail {

struct PlacedPart {
  fcl::Transform3d pose;  ///< world frame, metres

  /// The closed mesh that the part is; null for a mesh that counts as a surface and for a convex
  /// shape, whose C-obstacles are solid by themselves.
  const ClosedMesh* solid;

  /// Where its points may be besides: what is free is so for all motions in the set. All that they
  /// may fill counts as colliding, so that only the upper end of an interval is one of P. Null:
  /// nowhere else. No bands and no motion of the whole object may then be asked for besides.
  const PointMotion* sweep = nullptr;
};

/// A geometry, or a group of them that is displaced as one.
struct PartitionObject {
  const PieceTree* tree;
  std::vector<PlacedPart> parts;  ///< as many as tree->parts

  /// Null: it is where the poses say. Otherwise what is settled holds for all motions in the set;
  /// no estimate may then be asked for.
  const PointMotion* motion = nullptr;

  /// Whether any part is a closed mesh that counts as solid.
  bool hasSolid() const {
    return std::any_of(parts.begin(), parts.end(),
                       [](const PlacedPart& part) { return part.solid != nullptr; });
  }

  bool isSwept() const {
    return std::any_of(parts.begin(), parts.end(),
                       [](const PlacedPart& part) { return part.sweep != nullptr; });
  }
};

}  // namespace fcl_prob::detail
