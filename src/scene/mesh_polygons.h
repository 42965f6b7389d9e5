// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Coplanar triangles of a mesh taken together in convex polygons.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "fcl_prob/triangle_mesh.h"
#include "scene/flat_polygon.h"

namespace fcl_prob::detail {

/// The polygons of a mesh, with the triangles that are in none of them, in a tree of their own.
struct MeshPolygons {
  /// A node without children has a triangle; one that has a piece besides is a polygon, and what is
  /// below it is its triangles.
  struct Node {
    int left = -1;   ///< index of the first child, always greater than the node's own
    int right = -1;  ///< index of the second child
    int piece = -1;  ///< a triangle, or behind all those a polygon
  };

  std::vector<FlatPolygon> polygons;
  std::vector<Node> nodes;  ///< nodes[0] is the root

  /// Bytes.
  std::size_t memory() const;
};

/// Made when they are first asked for, by any of several threads.
class PolygonsOfMesh {
 public:
  /// Null where there are none.
  /// \param mesh  makes it: the same one in all calls
  const MeshPolygons* of(const std::function<TriangleMesh()>& mesh) const;

 private:
  mutable std::once_flag once_;
  mutable std::unique_ptr<const MeshPolygons> made_;
};

}  // namespace fcl_prob::detail
