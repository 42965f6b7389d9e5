// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Octrees of which FCL's traversal leaves out cells for reasons that no C-obstacle can know.
#pragma once

#include "fcl_prob/exceptions.h"
#include "geometry/geometry_kind.h"
#include "query/prepared_geometry.h"

namespace fcl_prob::detail {

/// \throws UnsupportedGeometry for two octrees, one with a cell both occupied and free (a log-odds
///         of 0 is, by default): whether FCL finds its contacts depends on the sizes of the cells
///         that the traversal compares it with on its way.
inline void requireDistinctCells(const PreparedGeometry& a, const PreparedGeometry& b) {
  const auto is_octree = [](const PreparedGeometry& geometry) {
    return kindOf(geometry.geometry()) == GeometryKind::octree;
  };
  if (!is_octree(a) || !is_octree(b)) return;
  if (a.pieces().any_cell_also_free || b.pieces().any_cell_also_free) {
    throw UnsupportedGeometry(
        "two octrees, one of which has a cell both occupied and free: fcl::collide leaves it out "
        "or not depending on the cells around it");
  }
}

}  // namespace fcl_prob::detail
