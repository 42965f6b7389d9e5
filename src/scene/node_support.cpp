// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/node_support.h"

#include <algorithm>
#include <limits>

namespace fcl_prob::detail {

namespace {

// So many triangles of a node are looked at one by one: they follow each other in memory, while
// boxes of smaller nodes would have to be fetched.
constexpr int kFewTriangles = 8;

}  // namespace

NodeSupport::NodeSupport(const WhitenedTree& mesh) : mesh_(&mesh), m_(Eigen::Vector3d::Zero()) {}

double NodeSupport::along(const Eigen::Vector3d& m, int node) {
  if (places_.empty()) places_.assign(mesh_->tree->nodes.size(), kNone);
  if (m != m_ || direction_ == 0) {
    m_ = m;
    ++direction_;
  }
  const PieceTree::Node& at = mesh_->tree->nodes[node];
  if (at.isLeaf()) return ofTriangles(at);
  const double* const known = valueOf(node);
  return known ? *known : search(node);
}

// Null if it is not known for this direction.
const double* NodeSupport::valueOf(int node) const {
  const int place = places_[node];
  if (place == kNone || known_[place].direction != direction_) return nullptr;
  return &known_[place].value;
}

void NodeSupport::note(int node, double value) {
  int& place = places_[node];
  if (place == kNone) {
    place = static_cast<int>(known_.size());
    known_.emplace_back();
  }
  known_[place] = {value, direction_};
}

// Of nodes of which no children need to be looked at; nothing of others.
std::optional<double> NodeSupport::ofFew(int node) const {
  const PieceTree& tree = *mesh_->tree;
  if (tree.clusters && node < tree.clusters->end) {
    if (node < tree.clusters->begin) return std::nullopt;
    return ofCluster(node);
  }
  const PieceTree::Node& at = tree.nodes[node];
  if (at.last_piece - at.piece < kFewTriangles) return ofTriangles(at);
  return std::nullopt;
}

double NodeSupport::ofCluster(int node) const {
  double value = -std::numeric_limits<double>::infinity();
  for (const int vertex : mesh_->tree->clusters->verticesOf(node)) {
    value = std::max(value, m_.dot(mesh_->vertices[vertex]));
  }
  return value;
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
  const auto reachOf = [this](int index, int parent) {
    return Reach{index, parent, mesh_->boxOf(index).highestAlong(m_)};
  };
  double best = -std::numeric_limits<double>::infinity();
  Opened farthest{node, kNone};
  opened_.clear();
  stack_.assign(1, {node, kNone, std::numeric_limits<double>::infinity()});
  while (!stack_.empty()) {
    const Reach reach = stack_.back();
    stack_.pop_back();
    if (reach.bound <= best) continue;
    const double* const known = valueOf(reach.node);
    if (const auto value = known ? *known : ofFew(reach.node)) {
      if (*value > best) {
        best = *value;
        farthest = {reach.node, reach.parent};
      }
      continue;
    }
    const PieceTree::Node& inner = tree.nodes[reach.node];
    const int parent = static_cast<int>(opened_.size());
    opened_.push_back({reach.node, reach.parent});
    Reach left = reachOf(inner.left, parent);
    Reach right = reachOf(inner.right, parent);
    if (left.bound > right.bound) std::swap(left, right);
    if (left.bound > best) stack_.push_back(left);
    if (right.bound > best) stack_.push_back(right);
  }
  note(farthest.node, best);
  for (int i = farthest.parent; i != kNone; i = opened_[i].parent) note(opened_[i].node, best);
  return best;
}

}  // namespace fcl_prob::detail
