// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A piece tree moved into the whitened frame of one query.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "base/kept_memory.h"
#include "convex/slab_kernels.h"
#include "fcl_prob/whitening.h"
#include "geometry/node_pair.h"
#include "scene/node_boxes.h"
#include "scene/partition_object.h"

namespace fcl_prob::detail {

/// Vertices and node boxes of one object in the whitened frame. With A's and B's trees of one
/// query, `b - a` over their points is the C-obstacle. All is relative to the middle of A's first
/// part, B also to the mean.
struct WhitenedTree {
  const PieceTree* tree = nullptr;
  std::vector<Eigen::Vector3d, KeptMemory<Eigen::Vector3d>> vertices;
  std::vector<Eigen::Matrix3d> linear;     ///< of each part: maps its axes to those of the frame
  std::vector<Eigen::Vector3d> offsets;    ///< of its origin
  std::vector<Eigen::Vector3d> positions;  ///< of tree->bodies
  std::vector<ConvexPiece> shapes;         ///< of tree->shapes
  std::vector<NodeBox> shape_boxes;        ///< around them, up to rounding

  NodeBoxes boxes;  ///< of tree->nodes

  /// Bound on the error of a vertex or point of a piece, for each axis.
  Eigen::Vector3d error = Eigen::Vector3d::Zero();

  /// How far the points of a node and the vertices may move besides, for each axis: empty for an
  /// object without PointMotion or sweeps. The boxes contain it.
  std::vector<Eigen::Vector3d> node_motions;
  std::vector<Eigen::Vector3d> vertex_motions;

  /// Around a node: valid until the tree is whitened anew.
  const NodeBox& boxOf(int node) const { return boxes.of(*this, node); }

  /// The error of the points of a node. Whoever uses it adds four of them; the motion needs to be
  /// in that once.
  Eigen::Vector3d errorOf(int node) const {
    return node_motions.empty() ? error : Eigen::Vector3d(error + 0.25 * node_motions[node]);
  }

  Eigen::Vector3d motionOf(int vertex) const {
    return vertex_motions.empty() ? Eigen::Vector3d::Zero().eval() : vertex_motions[vertex];
  }

  /// Bound on the error of m·v for such a point v; the rounding of the sum is within it, too.
  double errorAlong(const Eigen::Vector3d& m) const { return m.cwiseAbs().dot(error); }
  double errorAlong(const Eigen::Vector3d& m, int node) const {
    return node_motions.empty() ? errorAlong(m) : m.cwiseAbs().dot(errorOf(node));
  }
};

/// Around tree->bodies[body], padded as the boxes of nodes.
NodeBox bodyBox(const WhitenedTree& whitened, int body);

class BandMargin;
class TurningMargin;

struct WhitenedPair {
  WhitenedTree a;
  WhitenedTree b;

  /// What the bands around the two shapes, or the sweeps of their parts, do, which are all of their
  /// motions; null without either.
  std::shared_ptr<const BandMargin> band;

  /// What motions of the objects do to pairs of triangles, instead of their node_motions; null
  /// without motions, or with a band.
  std::shared_ptr<const TurningMargin> turning;
};

WhitenedPair whiten(const PartitionObject& a, const PartitionObject& b, const Whitening& whitening);

/// The same into the memory of an earlier one, which must not be referred to any more.
/// \param moved  how far B as a whole may be from where it is said to be, metres: it is part of the
///               error of its points
void whiten(const PartitionObject& a, const PartitionObject& b, const Whitening& whitening,
            WhitenedPair& result, double moved = 0.0);

/// Bound on the error of b - a over the points of two nodes, without what `band` pays for.
inline Eigen::Vector3d slabError(const WhitenedPair& pair, NodePair nodes) {
  if (pair.band) return pair.a.error + pair.b.error;
  return pair.a.errorOf(nodes.a) + pair.b.errorOf(nodes.b);
}

/// Whether both nodes are leaves.
inline bool areLeaves(const WhitenedPair& pair, NodePair nodes) {
  return pair.a.tree->nodes[nodes.a].isLeaf() && pair.b.tree->nodes[nodes.b].isLeaf();
}

/// The children of the larger node, each with the other node; not both may be leaves.
std::array<NodePair, 2> childrenOf(const WhitenedPair& pair, NodePair nodes);

/// Bounding box of the C-obstacle of two nodes: certainly contains it.
inline NodeBox obstacleBox(const NodeBox& a, const NodeBox& b) {
  return {{b.lo[0] - a.hi[0], b.lo[1] - a.hi[1], b.lo[2] - a.hi[2]},
          {b.hi[0] - a.lo[0], b.hi[1] - a.lo[1], b.hi[2] - a.lo[2]}};
}

inline NodeBox obstacleBox(const WhitenedPair& pair, NodePair nodes) {
  return obstacleBox(pair.a.boxOf(nodes.a), pair.b.boxOf(nodes.b));
}

}  // namespace fcl_prob::detail
