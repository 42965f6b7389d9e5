// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Triangles of a mesh that cover a convex polygon.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::detail {

/// Triangles and some of their corners: no point of the triangles is farther than `off` from the
/// hull of those corners, and no point of the hull farther from them (docs/rounding.md). The hull
/// is flat but for that.
struct FlatPolygon {
  std::vector<int> triangles;
  std::vector<int> corners;  ///< vertices of the mesh, in order around the normal
  Eigen::Vector3d normal;    ///< unit, about
  double off;                ///< metres
};

/// Nothing if they are found to cover none that is convex and flat to about `tolerance`, metres, or
/// one of very many corners. They may lie on each other, walk either way round, or have no area.
/// \param welded  of every vertex of the mesh the first one at the same place
std::optional<FlatPolygon> flatPolygonOf(const TriangleMesh& mesh, const std::vector<int>& welded,
                                         std::vector<int> triangles, double tolerance);

}  // namespace fcl_prob::detail
