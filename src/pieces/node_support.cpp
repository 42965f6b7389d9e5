// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pieces/node_support.h"

#include <algorithm>
#include <limits>

namespace fcl_prob::detail {

NodeSupport::NodeSupport(const WhitenedTree& mesh) : mesh_(&mesh), m_(Eigen::Vector3d::Zero()) {}

void NodeSupport::prepare() {
  const std::vector<PieceTree::Node>& nodes = mesh_->tree->nodes;
  value_.resize(nodes.size());
  known_in_.assign(nodes.size(), 0);
  parent_.assign(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].isLeaf()) continue;
    parent_[nodes[i].left] = static_cast<int>(i);
    parent_[nodes[i].right] = static_cast<int>(i);
  }
}

double NodeSupport::along(const Eigen::Vector3d& m, int node) {
  if (mesh_->tree->nodes[node].isLeaf()) return ofLeaf(m, node);
  if (parent_.empty()) prepare();
  if (m != m_) {
    m_ = m;
    ++direction_;
  }
  return isKnown(node) ? value_[node] : search(node);
}

void NodeSupport::note(int node, double value) {
  known_in_[node] = direction_;
  value_[node] = value;
}

double NodeSupport::ofLeaf(const Eigen::Vector3d& m, int leaf) const {
  const Eigen::Vector3i& t = mesh_->tree->triangles[mesh_->tree->nodes[leaf].piece];
  double value = -std::numeric_limits<double>::infinity();
  for (int corner = 0; corner < 3; ++corner) {
    value = std::max(value, m.dot(mesh_->vertices[t[corner]]));
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
  stack_.assign(1, {node, ofBox(node)});
  while (!stack_.empty()) {
    const auto [index, bound] = stack_.back();
    stack_.pop_back();
    if (bound <= best) continue;
    const PieceTree::Node& inner = tree.nodes[index];
    if (inner.isLeaf() || isKnown(index)) {
      const double value = inner.isLeaf() ? ofLeaf(m_, index) : value_[index];
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
  for (int i = farthest; i != node; i = parent_[i]) note(i, best);
  note(node, best);
  return best;
}

}  // namespace fcl_prob::detail
