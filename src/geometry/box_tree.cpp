// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/box_tree.h"

#include <algorithm>
#include <numeric>

namespace fcl_prob::detail {

BoxTree::BoxTree(const std::vector<Box>& boxes) {
  if (boxes.empty()) return;
  std::vector<int> order(boxes.size());
  std::iota(order.begin(), order.end(), 0);
  nodes_.reserve(2 * boxes.size());
  build(boxes, order, 0, static_cast<int>(boxes.size()));
}

int BoxTree::build(const std::vector<Box>& boxes, std::vector<int>& order, int first, int last) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Box whole;
  for (int i = first; i < last; ++i) whole.extend(boxes[order[i]]);
  nodes_[index].box = whole;
  if (last - first == 1) {
    nodes_[index].item = order[first];
    return index;
  }
  int axis = 0;
  whole.sizes().maxCoeff(&axis);
  const int middle = first + (last - first) / 2;
  std::nth_element(order.begin() + first, order.begin() + middle, order.begin() + last,
                   [&](int a, int b) {
                     return boxes[a].min()[axis] + boxes[a].max()[axis] <
                            boxes[b].min()[axis] + boxes[b].max()[axis];
                   });
  const int left = build(boxes, order, first, middle);
  const int right = build(boxes, order, middle, last);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

}  // namespace fcl_prob::detail
