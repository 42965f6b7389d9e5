// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/node_support.h"

#include <algorithm>
#include <limits>

namespace fcl_prob::detail {

NodeSupport::NodeSupport(const WhitenedTree& mesh) : mesh_(&mesh), m_(Eigen::Vector3d::Zero()) {}

double NodeSupport::along(const Eigen::Vector3d& m, int node) {
  if (value_.empty()) {
    value_.resize(mesh_->boxes.size());
    known_in_.assign(mesh_->boxes.size(), 0);
  }
  if (m != m_) {
    m_ = m;
    ++direction_;
  }
  if (known_in_[node] != direction_) {
    known_in_[node] = direction_;
    value_[node] = search(node);
  }
  return value_[node];
}

// Depth first, the farther child first; what cannot reach beyond the best so far is left out.
double NodeSupport::search(int node) {
  const PieceTree& tree = *mesh_->tree;
  const auto ofBox = [this](int index) { return mesh_->boxes[index].highestAlong(m_); };
  double best = -std::numeric_limits<double>::infinity();
  stack_.assign(1, node);
  while (!stack_.empty()) {
    const int index = stack_.back();
    stack_.pop_back();
    if (ofBox(index) <= best) continue;
    const PieceTree::Node& inner = tree.nodes[index];
    if (inner.isLeaf()) {
      const Eigen::Vector3i& t = tree.triangles[inner.piece];
      for (int corner = 0; corner < 3; ++corner) {
        best = std::max(best, m_.dot(mesh_->vertices[t[corner]]));
      }
      continue;
    }
    const bool left_last = ofBox(inner.left) > ofBox(inner.right);
    stack_.push_back(left_last ? inner.right : inner.left);
    stack_.push_back(left_last ? inner.left : inner.right);
  }
  return best;
}

}  // namespace fcl_prob::detail
