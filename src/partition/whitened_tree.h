// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A piece tree moved into the whitened frame of one query.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fcl_prob/whitening.h"
#include "partition/partition_object.h"
#include "partition/slab_kernels.h"

namespace fcl_prob::detail {

struct NodeBox {
  double lo[3];
  double hi[3];

  double size() const { return hi[0] - lo[0] + (hi[1] - lo[1]) + (hi[2] - lo[2]); }
};

/// A shape of the pieces and its extent, relative to the position of a piece.
struct WhitenedShape {
  PieceShape shape;
  Eigen::Vector3d lo;
  Eigen::Vector3d hi;
};

/// Vertices and node boxes of one object in the whitened frame. With A's and B's trees of one
/// query, `b - a` over their points is the C-obstacle. All is relative to the middle of A's first
/// part, B also to the mean.
struct WhitenedTree {
  const PieceTree* tree = nullptr;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3d> positions;  ///< of tree->bodies
  std::vector<WhitenedShape> shapes;
  std::vector<NodeBox> boxes;  ///< of tree->nodes, padded by `error`
  double error = 0.0;  ///< bound on the error of every coordinate of a vertex or point of a piece
};

struct WhitenedPair {
  WhitenedTree a;
  WhitenedTree b;
};

WhitenedPair whiten(const PartitionObject& a, const PartitionObject& b, const Whitening& whitening);

/// Bounding box of the C-obstacle of two nodes: certainly contains it.
inline NodeBox obstacleBox(const NodeBox& a, const NodeBox& b) {
  return {{b.lo[0] - a.hi[0], b.lo[1] - a.hi[1], b.lo[2] - a.hi[2]},
          {b.hi[0] - a.lo[0], b.hi[1] - a.lo[1], b.hi[2] - a.lo[2]}};
}

}  // namespace fcl_prob::detail
