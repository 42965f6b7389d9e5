// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Caps that close a surface, so that the parity of a ray's crossings says what is inside.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "geometry/mesh_visitor.h"

namespace fcl_prob::detail {

/// For every vertex the first vertex with the same coordinates (-0 equals 0).
std::vector<int> weldVertices(const MeshView& mesh);

/// The corners of a triangle, of which weldVertices() told what they are the same as.
inline std::array<int, 3> weldedCorners(const std::vector<int>& welded, const fcl::Triangle& t) {
  return {welded[t[0]], welded[t[1]], welded[t[2]]};
}

/// Whether a triangle with these corners, welded, has no inside to bound.
inline bool anyEqual(const std::array<int, 3>& corners) {
  return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
}

/// Which vertices hang together by triangles, those without area included.
struct SurfaceComponents {
  std::vector<int> of_vertex;  ///< -1 in no triangle
  int count = 0;
};

SurfaceComponents componentsOf(const MeshView& mesh, const std::vector<int>& welded);

/// A mesh and its caps together have an even number of triangles at every edge, whatever the mesh
/// is like: then a path between two points crosses them an odd number of times if and only if the
/// rays from the two points do in sum.
struct SurfaceCaps {
  struct Cap {
    Eigen::Vector3d apex;                  ///< metres, frame of the mesh; in the hull of its rim
    std::vector<std::pair<int, int>> rim;  ///< edges, each with the apex a triangle
  };
  std::vector<Cap> caps;  ///< one for every connected part of the edges with an odd number

  SurfaceComponents components;
};

SurfaceCaps capsOf(const MeshView& mesh);

}  // namespace fcl_prob::detail
