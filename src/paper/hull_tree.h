// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex hulls over the topology of a fcl::BVHModel.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "paper/bounding_tree.h"

namespace fcl_prob::detail {

/// See ConvexHullTree. All hulls are made at construction.
class HullTree final : public BoundingTree {
 public:
  template <typename BV>
  explicit HullTree(const fcl::BVHModel<BV>& model) {
    for (int node = 0; node < model.getNumBVs(); ++node) {
      const auto& bv = model.getBV(node);
      Node copy;
      copy.left = bv.isLeaf() ? -1 : bv.leftChild();
      if (bv.isLeaf()) {
        const fcl::Triangle& triangle = model.tri_indices[bv.primitiveId()];
        for (int corner = 0; corner < 3; ++corner) {
          copy.triangle[corner] = model.vertices[triangle[corner]];
        }
      }
      nodes_.push_back(std::move(copy));
    }
    build();
  }

  std::size_t nodeCount() const { return nodes_.size(); }

  int leftChild(int node) const override { return nodes_[node].left; }
  double volume(int node) const override { return nodes_[node].volume; }
  const ConvexSet& body(int node) const override { return *nodes_[node].body; }
  const ConvexSet& piece(int leaf) const override { return *nodes_[leaf].body; }
  double size() const override { return size_; }
  double slack() const override { return slack_; }

 private:
  struct Node {
    int left = -1;
    std::array<Eigen::Vector3d, 3> triangle;  // of a leaf
    ConvexSetPtr body;
    double volume = 0.0;
    double slack = 0.0;  // of the hulls down to the leaves
  };

  void build();
  ConvexMesh hullOf(const Node& node) const;

  std::vector<Node> nodes_;
  double size_ = 0.0;
  double slack_ = 0.0;
};

}  // namespace fcl_prob::detail
