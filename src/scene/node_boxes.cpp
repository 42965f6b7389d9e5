// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/node_boxes.h"

#include "scene/whitened_tree.h"

namespace fcl_prob::detail {

namespace {

// Adding the error is monotonic: to the bit this is what contains the boxes of triangles.
NodeBox boxOfVertices(const WhitenedTree& whitened, const int* begin, const int* end) {
  Eigen::Vector3d lo = whitened.vertices[*begin];
  Eigen::Vector3d hi = lo;
  for (const int* vertex = begin + 1; vertex != end; ++vertex) {
    lo = lo.cwiseMin(whitened.vertices[*vertex]);
    hi = hi.cwiseMax(whitened.vertices[*vertex]);
  }
  return paddedBox(lo, hi, whitened.error);
}

NodeBox boxOfCluster(const WhitenedTree& whitened, int index) {
  const auto vertices = whitened.tree->clusters->verticesOf(index);
  return boxOfVertices(whitened, vertices.begin(), vertices.end());
}

NodeBox boxOfLeaf(const WhitenedTree& whitened, int index) {
  const PieceTree& tree = *whitened.tree;
  const PieceTree::Node& leaf = tree.nodes[index];
  NodeBox box;
  if (tree.isTriangle(leaf.piece)) {
    const int* const corners = tree.triangles[leaf.piece].data();
    box = boxOfVertices(whitened, corners, corners + 3);
  } else {
    box = bodyBox(whitened, tree.bodyOf(leaf.piece));
  }
  if (whitened.node_motions.empty()) return box;
  for (int k = 0; k < 3; ++k) {
    box.lo[k] -= whitened.node_motions[index][k];
    box.hi[k] += whitened.node_motions[index][k];
  }
  return box;
}

}  // namespace

// Children stand behind their parents.
void NodeBoxes::fit(const WhitenedTree& whitened) {
  const PieceTree& tree = *whitened.tree;
  const bool late = tree.clusters && whitened.node_motions.empty();
  const int count = static_cast<int>(tree.nodes.size());
  const int first_cluster = late ? tree.clusters->begin : count;
  first_late_ = late ? tree.clusters->end : count;
  late_ = std::make_unique<Late>(count - first_late_);
  boxes_.clear();
  boxes_.resize(count, boost::container::default_init);
  for (int i = first_late_; i-- > 0;) {
    const PieceTree::Node& node = tree.nodes[i];
    boxes_[i] = i >= first_cluster ? boxOfCluster(whitened, i)
                : node.isLeaf()    ? boxOfLeaf(whitened, i)
                                   : boxOfBoth(boxes_[node.left], boxes_[node.right]);
  }
}

// Once a node is looked at its children soon are, too.
void NodeBoxes::makeUnder(const WhitenedTree& whitened, int node) const {
  const std::lock_guard lock(late_->mutex);
  make(whitened, node);
}

const NodeBox& NodeBoxes::make(const WhitenedTree& whitened, int index) const {
  std::atomic<bool>& made = late_->made[index - first_late_];
  NodeBox& box = boxes_[index];
  if (made.load(std::memory_order_relaxed)) return box;
  const PieceTree::Node& node = whitened.tree->nodes[index];
  box = node.isLeaf() ? boxOfLeaf(whitened, index)
                      : boxOfBoth(make(whitened, node.left), make(whitened, node.right));
  made.store(true, std::memory_order_release);
  return box;
}

}  // namespace fcl_prob::detail
