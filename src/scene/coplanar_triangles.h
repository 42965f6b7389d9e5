// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Coplanar triangles of a mesh, open or closed, taken together in convex polygons.
#pragma once

#include <vector>

#include "scene/flat_polygon.h"

namespace fcl_prob::detail {

/// Polygons of at least two triangles each that hang together by edges; no triangle is in two of
/// them.
/// \param welded  of every vertex the first one at the same place
std::vector<FlatPolygon> flatPolygonsIn(const TriangleMesh& mesh, const std::vector<int>& welded);

}  // namespace fcl_prob::detail
