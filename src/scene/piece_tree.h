// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Geometries as a binary tree over convex pieces: what the partition keeps of them between queries.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Core>
#include <boost/range/iterator_range.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/surface_caps.h"
#include "scene/convex_fan.h"
#include "scene/convex_piece.h"
#include "scene/mesh_polygons.h"
#include "scene/nearly_convex.h"

namespace fcl_prob::detail {

class SlabsOfNodes;

/// What closes meshes, for the question which points are inside an odd number of them: caps over
/// their open boundaries.
struct MeshCaps {
  struct Cap {
    int first;  ///< of its triangles
    int last;   ///< one behind the last
  };
  std::vector<Cap> caps;
  std::vector<Eigen::Vector3i> triangles;  ///< indices into the tree's vertices
  SurfaceComponents components;            ///< of the meshes' own vertices only
};

/// The largest nodes of a single mesh with no more than kMostTriangles. Nodes come in this order:
/// those above clusters, clusters, those below.
struct MeshClusters {
  static constexpr int kMostTriangles = 16;

  int begin = 0;              ///< the first node that is one
  int end = 0;                ///< the first node below them
  std::vector<int> vertices;  ///< of one cluster after the other, each vertex of it once
  std::vector<int> first;     ///< where those of a cluster begin; one more for the end

  /// Of a node that is a cluster.
  boost::iterator_range<const int*> verticesOf(int node) const {
    const int* const of_cluster = &first[node - begin];
    return {vertices.data() + of_cluster[0], vertices.data() + of_cluster[1]};
  }
};

/// The topology is that of FCL's own tree; bounding volumes are left out, since the partition
/// refits axis-aligned boxes in the whitened frame of each query. An octree without occupied cells
/// has no nodes.
///
/// A group of geometries is one tree, with a few nodes above their own: the C-obstacle of two
/// groups, the union of those of their parts, then needs nothing that one pair does not need.
struct PieceTree {
  struct Node {
    int left = -1;   ///< index of the first child, always greater than the node's own; -1 at a leaf
    int right = -1;  ///< index of the second child; -1 at a leaf
    /// At a leaf: its triangle; from triangles.size() on, its body. Of an inner node of meshes: the
    /// first of its triangles, which follow each other.
    int piece = -1;
    int last_piece = -1;  ///< of a node of meshes: the last of its triangles
    bool isLeaf() const { return left < 0; }
  };

  /// A convex piece that is no triangle of a mesh.
  struct Body {
    Eigen::Vector3d position;  ///< metres, relative to the origin of its part
    int shape;                 ///< index into `shapes`
  };

  struct Range {
    int begin = 0;
    int end = 0;
  };

  /// One geometry: what has a pose of its own.
  struct Part {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< metres, geometry's frame
    double radius = 0.0;  ///< metres: of a ball around `origin` with everything
    double error = 0.0;   ///< metres: by how much coordinates differ from those of the geometry
    int root = -1;        ///< its topmost node, -1 if it has none
    Range vertices;
    /// Of the geometry's vertices, within `vertices`; empty where they come in its order.
    std::vector<int> places;
    Range triangles;
    Range bodies;
    Range shapes;

    /// Of a mesh that is convex, or a convex polytope, relative to `origin`; else null.
    std::shared_ptr<const ConvexFan> fan;
    /// Of one that is so nearly, relative to `origin`; else null.
    std::shared_ptr<const NearlyConvex> nearly;
    /// Of a mesh, indices into the tree's vertices: see spansOf().
    std::vector<std::pair<int, int>> spans;
    /// Of a mesh; null of what is none. See polygonsOf().
    std::shared_ptr<const PolygonsOfMesh> polygons;
    /// Of a mesh; null of what is none.
    std::shared_ptr<const SlabsOfNodes> slabs;
  };

  std::vector<Node> nodes;               ///< nodes[0] is the root
  std::optional<MeshClusters> clusters;  ///< of a single mesh
  std::vector<Part> parts;
  std::vector<Eigen::Vector3d> vertices;   ///< metres, relative to the origin of their part
  std::vector<Eigen::Vector3i> triangles;  ///< indices of vertices
  std::vector<Body> bodies;
  std::vector<ConvexPiece> shapes;  ///< in the axes of their part
  std::optional<MeshCaps> caps;     ///< of one or more meshes and nothing else

  /// Of an octree: a cell is both occupied and free.
  bool any_cell_also_free = false;

  /// Where vertex `v` of the geometry of a part is among `vertices`.
  static int vertexOf(const Part& part, std::size_t v) {
    return part.vertices.begin + (part.places.empty() ? static_cast<int>(v) : part.places[v]);
  }

  /// Of a part that is a mesh, with indices into its own triangles and vertices; null if it has
  /// none.
  const MeshPolygons* polygonsOf(const Part& part) const;

  bool isMesh() const { return bodies.empty(); }
  bool isEmpty() const { return nodes.empty(); }

  bool isTriangle(int piece) const { return piece < static_cast<int>(triangles.size()); }
  int bodyOf(int piece) const { return piece - static_cast<int>(triangles.size()); }

  /// Of the largest part, metres.
  double radius() const;

  /// The largest of those of the parts, metres.
  double error() const;
};

/// A tree of one part. \throws UnsupportedGeometry for unbounded shapes, InvalidGeometry for broken
/// ones.
std::shared_ptr<const PieceTree> buildPieceTree(const fcl::CollisionGeometryd& geometry);

/// One tree of many, part by part in their order.
/// \param poses  about where they are, in one frame, where the same trees in a row are to be
///               interwoven (joined_top.h); nothing but the time that queries take depends on it
std::shared_ptr<const PieceTree> joinPieceTrees(const std::vector<const PieceTree*>& trees,
                                                const std::vector<fcl::Transform3d>& poses = {});

}  // namespace fcl_prob::detail
