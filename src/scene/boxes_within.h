// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Which of many boxes, moved, lie within another one.
#pragma once

#include <vector>

#include "scene/whitened_tree.h"

namespace fcl_prob::detail {

/// Boxes in a binary tree, split at the median. A node keeps how far to the inside the sides of its
/// boxes lie at most: if even those lie outside, no box lies within.
class BoxesWithin {
 public:
  BoxesWithin() = default;
  explicit BoxesWithin(const std::vector<NodeBox>& boxes);

  /// Calls `function(index)` for every box that lies within `around` after some move in
  /// [least, most]; stops and returns false as soon as one call returns false. The sums are
  /// rounded.
  template <typename Function>
  bool visit(const Eigen::Vector3d& least, const Eigen::Vector3d& most, const NodeBox& around,
             Function&& function) const;

 private:
  struct Node {
    Eigen::Vector3d highest_lo;
    Eigen::Vector3d lowest_hi;
    int skip;  ///< the node after all of its own
    int item;  ///< of a leaf, else -1
  };

  static bool mayFit(const Node& node, const Eigen::Vector3d& least, const Eigen::Vector3d& most,
                     const NodeBox& around) {
    for (int k = 0; k < 3; ++k) {
      if (node.highest_lo[k] + most[k] < around.lo[k]) return false;
      if (node.lowest_hi[k] + least[k] > around.hi[k]) return false;
    }
    return true;
  }

  void build(const std::vector<NodeBox>& boxes, std::vector<int>& order, std::size_t first,
             std::size_t last);

  std::vector<Node> nodes_;  ///< a node, then all below its first child, then below its second
};

template <typename Function>
bool BoxesWithin::visit(const Eigen::Vector3d& least, const Eigen::Vector3d& most,
                        const NodeBox& around, Function&& function) const {
  const int count = static_cast<int>(nodes_.size());
  for (int i = 0; i < count;) {
    const Node& node = nodes_[i];
    if (!mayFit(node, least, most, around)) {
      i = node.skip;
      continue;
    }
    if (node.item >= 0 && !function(node.item)) return false;
    ++i;
  }
  return true;
}

}  // namespace fcl_prob::detail
