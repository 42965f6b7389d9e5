// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Triangles over a depth image, large where it is flat.
#pragma once

#include <vector>

#include "cloud/depth_grid.h"
#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::detail {

struct GridMesh {
  TriangleMesh mesh;        ///< frame of the points; triangles are seen from their front
  std::vector<int> pixels;  ///< of its vertices
  double deviation = 0.0;   ///< metres: the farthest pixel from the mesh, along the triangle
};

/// A right-triangulated irregular network (Evans, Kirkpatrick, Townsend 2001), without cracks: a
/// triangle stands for all pixels in it only if all of them have depth, no jump is among them and
/// none is farther than `most` from the triangle.
/// \param across_jumps  triangles may span jumps: one surface from the nearest to the farthest
GridMesh meshOf(const DepthGrid& grid, double most, bool across_jumps);

/// What lies between a mesh and its shadow, `depth` farther from `eye`: closed where the mesh's
/// edges have one or two triangles.
TriangleMesh shadowOf(const TriangleMesh& front, const Eigen::Vector3d& eye, double depth);

}  // namespace fcl_prob::detail
