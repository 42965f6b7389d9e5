// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/box_tree.h"

#include <algorithm>

namespace fcl_prob::detail {

BoxTree::BoxTree(const std::vector<Box>& boxes) {
  if (boxes.empty()) return;
  items_.reserve(boxes.size());
  for (const Box& box : boxes) items_.push_back({box, static_cast<int>(items_.size())});
  nodes_.reserve(boxes.size());
  build(0, static_cast<int>(boxes.size()));
}

void BoxTree::build(int first, int last) {
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  Box whole;
  for (int i = first; i < last; ++i) whole.extend(items_[i].box);
  nodes_[index].box = whole;
  if (last - first <= kMostOfLeaf) {
    nodes_[index].first = first;
    nodes_[index].last = last;
    return;
  }
  int axis = 0;
  whole.sizes().maxCoeff(&axis);
  const int middle = first + (last - first) / 2;
  const auto at = [this](int i) { return items_.begin() + i; };
  std::nth_element(at(first), at(middle), at(last), [axis](const Item& a, const Item& b) {
    return a.box.min()[axis] + a.box.max()[axis] < b.box.min()[axis] + b.box.max()[axis];
  });
  build(first, middle);
  nodes_[index].right = static_cast<int>(nodes_.size());
  build(middle, last);
}

}  // namespace fcl_prob::detail
