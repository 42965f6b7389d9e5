// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/octree_pieces.h"

#include <algorithm>
#include <array>

#include "base/constants.h"

namespace fcl_prob::detail {

namespace {

using Box = fcl::AABBd;
using OcTreeNode = fcl::OcTreed::OcTreeNode;

// Builds subtrees before their parents, so that children come first; the order of the nodes is
// turned round at the end.
class OcTreeReader {
 public:
  OcTreeReader(const fcl::OcTreed& octree, PieceTree& tree) : octree_(octree), tree_(tree) {}

  void run() {
    const Subtree root = read(octree_.getRoot(), octree_.getRootBV(), 0);
    if (root.fills) addPiece(octree_.getRootBV(), 0);
    std::reverse(tree_.nodes.begin(), tree_.nodes.end());
    const int last = static_cast<int>(tree_.nodes.size()) - 1;
    for (PieceTree::Node& node : tree_.nodes) {
      if (node.isLeaf()) continue;
      node.left = last - node.left;
      node.right = last - node.right;
    }
  }

 private:
  // The occupied part of a cell: all of it (without a node yet), a node, or nothing (-1).
  struct Subtree {
    bool fills = false;
    int node = -1;
  };

  Subtree read(const OcTreeNode* node, const Box& box, int depth) {
    if (!octree_.nodeHasChildren(node)) {
      const bool occupied = octree_.isNodeOccupied(node);
      tree_.any_cell_also_free |= occupied && octree_.isNodeFree(node);
      return {occupied, -1};
    }
    if (octree_.isNodeFree(node) || !octree_.isNodeOccupied(node)) return {};
    std::array<Box, 8> boxes;
    std::array<Subtree, 8> children;
    for (unsigned int i = 0; i < 8; ++i) {
      fcl::computeChildBV(box, i, boxes[i]);
      if (!octree_.nodeChildExists(node, i)) continue;
      children[i] = read(octree_.getNodeChild(node, i), boxes[i], depth + 1);
    }
    const auto fills = [](const Subtree& child) { return child.fills; };
    if (std::all_of(children.begin(), children.end(), fills)) return {true, -1};
    for (unsigned int i = 0; i < 8; ++i) {
      if (children[i].fills) children[i].node = addPiece(boxes[i], depth + 1);
    }
    return {false, join(children, 0, 8)};
  }

  // Halves along z, then y, then x: the bits of a child's index.
  int join(const std::array<Subtree, 8>& children, std::size_t first, std::size_t last) {
    if (last - first == 1) return children[first].node;
    const std::size_t middle = (first + last) / 2;
    const int left = join(children, first, middle);
    const int right = join(children, middle, last);
    if (left < 0 || right < 0) return std::max(left, right);
    return addNode({left, right, -1});
  }

  int addPiece(const Box& box, int depth) {
    if (shape_of_depth_.size() <= static_cast<std::size_t>(depth)) {
      shape_of_depth_.resize(static_cast<std::size_t>(depth) + 1, -1);
    }
    int& shape = shape_of_depth_[static_cast<std::size_t>(depth)];
    if (shape < 0) {
      shape = static_cast<int>(tree_.shapes.size());
      tree_.shapes.push_back(cubePiece(box.max_[0] - box.min_[0]));
    }
    tree_.bodies.push_back({box.center(), shape});
    return addNode({-1, -1, static_cast<int>(tree_.bodies.size()) - 1});
  }

  int addNode(const PieceTree::Node& node) {
    tree_.nodes.push_back(node);
    return static_cast<int>(tree_.nodes.size()) - 1;
  }

  const fcl::OcTreed& octree_;
  PieceTree& tree_;
  std::vector<int> shape_of_depth_;
};

}  // namespace

double fillOcTree(const fcl::OcTreed& octree, PieceTree& tree) {
  OcTreeReader(octree, tree).run();
  const Box root = octree.getRootBV();
  // A cell's middle, and its own side beside that of the first one of its depth.
  return 4 * kEpsilon * std::max(root.min_.cwiseAbs().maxCoeff(), root.max_.cwiseAbs().maxCoeff());
}

}  // namespace fcl_prob::detail
