// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A bounding volume tree of axis-aligned boxes.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace fcl_prob::detail {

/// Axis-aligned boxes in a binary tree, split at the median; memory linear in their number.
class BoxTree {
 public:
  using Box = Eigen::AlignedBox3d;

  BoxTree() = default;
  explicit BoxTree(const std::vector<Box>& boxes);

  /// Around all boxes, of which there has to be one.
  const Box& bounds() const { return nodes_.front().box; }

  /// Calls `function(index)` for every box that `other` meets; touching counts. It may be endless.
  /// Stops and returns false as soon as one call returns false.
  template <typename Function>
  bool visitBox(const Box& other, Function&& function) const;

  /// Calls `function(index)`, which returns how far what is sought may be, for boxes that are
  /// nearer to the point, near ones first.
  template <typename Function>
  void visitNearest(const Eigen::Vector3d& point, Function&& function) const;

  /// Bytes.
  std::size_t memory() const {
    return nodes_.capacity() * sizeof(Node) + items_.capacity() * sizeof(Item);
  }

 private:
  // Splitting at the median makes the depth at most the number of bits of an int.
  static constexpr std::size_t kStackSize = 64;

  // Boxes of a leaf, which follow each other in memory: fetching nodes is what a visit waits for.
  static constexpr int kMostOfLeaf = 4;

  struct Node {
    Box box;
    int right = -1;  // the second child; the first one comes right behind its parent
    int first = 0;   // of the items of a leaf
    int last = 0;    // one behind the last of them

    bool isLeaf() const { return right < 0; }
  };
  struct Item {
    Box box;
    int index;
  };

  void build(int first, int last);

  std::vector<Node> nodes_;
  std::vector<Item> items_;
};

template <typename Function>
bool BoxTree::visitBox(const Box& other, Function&& function) const {
  std::array<int, kStackSize> stack;
  std::size_t size = 0;
  if (!nodes_.empty()) stack[size++] = 0;
  while (size > 0) {
    const int index = stack[--size];
    const Node& node = nodes_[index];
    if (!node.box.intersects(other)) continue;
    if (!node.isLeaf()) {
      stack[size++] = node.right;
      stack[size++] = index + 1;
      continue;
    }
    for (int i = node.first; i < node.last; ++i) {
      if (items_[i].box.intersects(other) && !function(items_[i].index)) return false;
    }
  }
  return true;
}

template <typename Function>
void BoxTree::visitNearest(const Eigen::Vector3d& point, Function&& function) const {
  struct Waiting {
    double distance;
    int node;
  };
  std::array<Waiting, kStackSize> stack;
  std::size_t size = 0;
  double most = std::numeric_limits<double>::infinity();
  if (!nodes_.empty()) stack[size++] = {0.0, 0};
  while (size > 0) {
    const auto [distance, index] = stack[--size];
    if (distance >= most) continue;
    const Node& node = nodes_[index];
    for (int i = node.first; i < node.last; ++i) {
      if (items_[i].box.exteriorDistance(point) < most) most = function(items_[i].index);
    }
    if (node.isLeaf()) continue;
    const Waiting low{nodes_[index + 1].box.exteriorDistance(point), index + 1};
    const Waiting high{nodes_[node.right].box.exteriorDistance(point), node.right};
    const bool low_first = low.distance < high.distance;
    stack[size++] = low_first ? high : low;
    stack[size++] = low_first ? low : high;
  }
}

}  // namespace fcl_prob::detail
