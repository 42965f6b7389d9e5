// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pieces/node_support.h"

#include <algorithm>
#include <limits>

namespace fcl_prob::detail {

namespace {

// So many triangles of a node are looked at one by one: they follow each other in memory, while
// boxes of smaller nodes would have to be fetched.
constexpr int kFewTriangles = 8;

}  // namespace

NodeSupport::NodeSupport(const WhitenedTree& mesh) : mesh_(&mesh), m_(Eigen::Vector3d::Zero()) {}

void NodeSupport::prepare() {
  const std::vector<PieceTree::Node>& nodes = mesh_->tree->nodes;
  known_.assign(nodes.size(), {});
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].isLeaf()) continue;
    known_[nodes[i].left].parent = static_cast<int>(i);
    known_[nodes[i].right].parent = static_cast<int>(i);
  }
}

double NodeSupport::along(const Eigen::Vector3d& m, int node) {
  if (known_.empty()) prepare();
  if (m != m_ || direction_ == 0) {
    m_ = m;
    ++direction_;
  }
  const PieceTree::Node& at = mesh_->tree->nodes[node];
  if (at.isLeaf()) return ofTriangles(at);
  return isKnown(node) ? known_[node].value : search(node);
}

void NodeSupport::note(int node, double value) {
  known_[node].direction = direction_;
  known_[node].value = value;
}

double NodeSupport::ofTriangles(const PieceTree::Node& node) const {
  double value = -std::numeric_limits<double>::infinity();
  for (int piece = node.piece; piece <= node.last_piece; ++piece) {
    for (const int corner : mesh_->tree->triangles[piece]) {
      value = std::max(value, m_.dot(mesh_->vertices[corner]));
    }
  }
  return value;
}

// Depth first, the farther child first; what cannot reach beyond the best so far is left out. The
// nodes between the farthest vertex and `node` reach as far as `node` does.
double NodeSupport::search(int node) {
  const PieceTree& tree = *mesh_->tree;
  const auto ofBox = [this](int index) { return mesh_->boxes[index].highestAlong(m_); };
  double best = -std::numeric_limits<double>::infinity();
  int farthest = node;
  stack_.assign(1, {node, std::numeric_limits<double>::infinity()});
  while (!stack_.empty()) {
    const auto [index, bound] = stack_.back();
    stack_.pop_back();
    if (bound <= best) continue;
    const PieceTree::Node& inner = tree.nodes[index];
    const bool known = isKnown(index);
    if (known || inner.last_piece - inner.piece < kFewTriangles) {
      const double value = known ? known_[index].value : ofTriangles(inner);
      if (value > best) {
        best = value;
        farthest = index;
      }
      continue;
    }
    Reach left{inner.left, ofBox(inner.left)};
    Reach right{inner.right, ofBox(inner.right)};
    if (left.bound > right.bound) std::swap(left, right);
    if (left.bound > best) stack_.push_back(left);
    if (right.bound > best) stack_.push_back(right);
  }
  for (int i = farthest; i != node; i = known_[i].parent) note(i, best);
  note(node, best);
  return best;
}

}  // namespace fcl_prob::detail
