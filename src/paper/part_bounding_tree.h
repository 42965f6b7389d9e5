// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Bounding volumes over convex parts.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fcl_prob/part_tree.h"
#include "paper/bounding_tree.h"

namespace fcl_prob::detail {

/// See PartTree. All bodies are made at construction, so that queries may share it.
class PartBoundingTree final : public BoundingTree {
 public:
  PartBoundingTree(const ConvexParts& parts, PartVolume volume);

  PartVolume boundingVolume() const { return volume_; }
  std::size_t nodeCount() const { return nodes_.size(); }

  int leftChild(int node) const override { return nodes_[node].left; }
  double volume(int node) const override { return nodes_[node].volume; }
  const ConvexSet& body(int node) const override { return nodes_[node].body->set(); }
  const ConvexSet& piece(int leaf) const override { return nodes_[leaf].piece->set(); }
  double size() const override { return size_; }
  double slack() const override { return slack_; }

 private:
  struct Node {
    int left = -1;
    std::optional<ConvexBody> body;
    std::optional<ConvexBody> piece;  // of a leaf
    double volume = 0.0;
  };

  /// A part, or the union of two branches.
  struct Branch {
    std::size_t part;
    int left;
    int right;
    std::vector<Eigen::Vector3d> points;
  };

  void fill(Node& node, const Branch& branch, const ConvexParts& parts);

  PartVolume volume_;
  std::vector<Node> nodes_;
  double size_ = 0.0;
  double slack_ = 0.0;
};

}  // namespace fcl_prob::detail
