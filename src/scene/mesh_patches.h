// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Triangles of a mesh taken together: coplanar ones in convex polygons, and of a closed mesh these
// and others in convex bodies within it.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "fcl_prob/triangle_mesh.h"
#include "geometry/closed_mesh.h"
#include "scene/convex_fan.h"
#include "scene/flat_polygon.h"

namespace fcl_prob::detail {

/// Some triangles and polygons of a mesh, and the hull K of their corners.
struct MeshPatch {
  std::vector<int> pieces;    ///< triangles, or behind all those polygons
  std::vector<int> vertices;  ///< of which K is the hull
  double off = 0.0;           ///< metres: its triangles stick out of K by no more

  /// K: the mesh winds around it, and no triangle of the mesh reaches farther into it than the
  /// depths tell. Without vertices.
  ConvexFan fan;
};

/// The polygons and patches of a mesh, with the triangles that are in none of them, in a tree of
/// their own.
struct MeshPatches {
  /// A node without children has a triangle; one that has a piece besides is a polygon or a patch,
  /// and what is below it is what that consists of.
  struct Node {
    int left = -1;   ///< index of the first child, always greater than the node's own
    int right = -1;  ///< index of the second child
    int piece = -1;  ///< a triangle, behind all those a polygon, behind all these a patch
  };

  std::vector<FlatPolygon> polygons;
  std::vector<MeshPatch> patches;
  std::vector<Node> nodes;          ///< nodes[0] is the root
  std::optional<ClosedMesh> solid;  ///< the mesh, if there are patches

  /// Bytes.
  std::size_t memory() const;

  /// About what that is at the most, of a mesh of so many triangles: if they are in pairs.
  static std::size_t mostMemory(std::size_t triangles) { return 500 * triangles; }
};

/// Made when they are first asked for, by any of several threads.
class PatchesOfMesh {
 public:
  /// Null where there are neither polygons nor patches.
  /// \param mesh  makes it: the same one in all calls
  const MeshPatches* of(const std::function<TriangleMesh()>& mesh) const;

 private:
  mutable std::once_flag once_;
  mutable std::unique_ptr<const MeshPatches> made_;
};

}  // namespace fcl_prob::detail
