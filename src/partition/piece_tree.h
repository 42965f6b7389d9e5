// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A geometry as a binary tree over convex pieces: what the partition keeps of it between queries.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "cobstacle/support_shape.h"

namespace fcl_prob::detail {

/// A convex piece relative to its position, with what its C-obstacles need: if it is a polytope,
/// every face as a pair of spanning vectors, and the directions of the edges. All of it transforms
/// linearly.
struct PieceShape {
  SupportShape body;
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> faces;
  std::vector<Eigen::Vector3d> edges;
};

/// The topology is that of FCL's own tree; bounding volumes are left out, since the partition
/// refits axis-aligned boxes in the whitened frame of each query. An octree without occupied cells
/// has no nodes.
struct PieceTree {
  struct Node {
    int left = -1;   ///< index of the first child, always greater than the node's own; -1 at a leaf
    int right = -1;  ///< index of the second child; -1 at a leaf
    int piece = -1;  ///< at a leaf: its triangle, or its piece
    bool isLeaf() const { return left < 0; }
  };

  std::vector<Node> nodes;                           ///< nodes[0] is the root
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< metres, geometry's frame
  /// Metres, relative to `origin`: of a mesh its vertices, of anything else where the pieces are.
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;  ///< of a mesh
  std::vector<int> pieces;                 ///< of anything else: which of the shapes each piece has
  std::vector<PieceShape> shapes;          ///< in the geometry's axes
  double radius = 0.0;                     ///< metres: of a ball around `origin` with everything
  bool isMesh() const { return shapes.empty(); }
  bool isEmpty() const { return nodes.empty(); }
};

/// \throws UnsupportedGeometry for unbounded shapes, InvalidGeometry for broken ones.
std::shared_ptr<const PieceTree> buildPieceTree(const fcl::CollisionGeometryd& geometry);

}  // namespace fcl_prob::detail
