// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A mesh in the whitened frame together with the caps that close it: what is inside of it.
#pragma once

#include <optional>
#include <vector>

#include "scene/whitened_tree.h"

namespace fcl_prob::detail {

class CappedTree {
 public:
  /// Keeps a reference to `mesh`, which must have caps.
  explicit CappedTree(const WhitenedTree& mesh);

  const WhitenedTree& mesh() const { return *mesh_; }
  const MeshCaps& caps() const { return *mesh_->tree->caps; }

  int componentOf(int vertex) const { return caps().components.of_vertex[vertex]; }

  /// Around each cap.
  const std::vector<NodeBox>& capBoxes() const { return cap_boxes_; }

  /// Calls `function(triangle)` for every triangle of the mesh and of its caps whose box meets
  /// [lo, hi]; stops and returns false as soon as one call returns false.
  template <typename Function>
  bool visitTriangles(const double* lo, const double* hi, Function&& function);

  /// Whether the box of no triangle of the mesh and its caps meets [lo, hi].
  bool isFree(const double* lo, const double* hi) {
    return visitTriangles(lo, hi, [](const Eigen::Vector3i&) { return false; });
  }

  /// Whether the box of no triangle of the mesh, caps aside, meets [lo, hi].
  bool isFreeOfMesh(const double* lo, const double* hi);

  /// Whether the ray from `point` along an axis crosses the mesh and its caps an odd number of
  /// times; nothing if a triangle is too close to the ray to tell.
  std::optional<bool> isInside(const Eigen::Vector3d& point, int axis);

 private:
  template <typename Function>
  bool visitMesh(const double* lo, const double* hi, Function&& function);
  template <typename Function>
  bool visitCaps(const double* lo, const double* hi, Function&& function) const;
  NodeBox boxOfCapTriangles(int first, int last) const;

  const WhitenedTree* mesh_;
  std::vector<NodeBox> cap_boxes_;
  std::vector<NodeBox> cap_triangle_boxes_;
  std::vector<int> stack_;
};

template <typename Function>
bool CappedTree::visitTriangles(const double* lo, const double* hi, Function&& function) {
  return visitMesh(lo, hi, function) && visitCaps(lo, hi, function);
}

template <typename Function>
bool CappedTree::visitMesh(const double* lo, const double* hi, Function&& function) {
  const PieceTree& tree = *mesh_->tree;
  stack_.clear();
  const auto push = [&](int index) {
    if (!isClearOf(mesh_->boxOf(index), lo, hi)) stack_.push_back(index);
  };
  push(0);
  while (!stack_.empty()) {
    const PieceTree::Node& node = tree.nodes[stack_.back()];
    stack_.pop_back();
    if (!node.isLeaf()) {
      push(node.left);
      push(node.right);
    } else if (!function(tree.triangles[node.piece])) {
      return false;
    }
  }
  return true;
}

template <typename Function>
bool CappedTree::visitCaps(const double* lo, const double* hi, Function&& function) const {
  for (std::size_t cap = 0; cap < cap_boxes_.size(); ++cap) {
    if (isClearOf(cap_boxes_[cap], lo, hi)) continue;
    for (int t = caps().caps[cap].first; t < caps().caps[cap].last; ++t) {
      if (isClearOf(cap_triangle_boxes_[t], lo, hi)) continue;
      if (!function(caps().triangles[t])) return false;
    }
  }
  return true;
}

}  // namespace fcl_prob::detail
