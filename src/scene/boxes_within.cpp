// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/boxes_within.h"

#include <algorithm>
#include <numeric>

namespace fcl_prob::detail {

namespace {

Eigen::Vector3d lowOf(const NodeBox& box) { return {box.lo[0], box.lo[1], box.lo[2]}; }
Eigen::Vector3d highOf(const NodeBox& box) { return {box.hi[0], box.hi[1], box.hi[2]}; }

// Along which the middles of some of the boxes are spread most.
int widestAxis(const std::vector<NodeBox>& boxes, const std::vector<int>& order, std::size_t first,
               std::size_t last) {
  Eigen::Vector3d least = lowOf(boxes[order[first]]) + highOf(boxes[order[first]]);
  Eigen::Vector3d most = least;
  for (std::size_t i = first + 1; i < last; ++i) {
    const Eigen::Vector3d twice = lowOf(boxes[order[i]]) + highOf(boxes[order[i]]);
    least = least.cwiseMin(twice);
    most = most.cwiseMax(twice);
  }
  int axis = 0;
  (most - least).maxCoeff(&axis);
  return axis;
}

}  // namespace

BoxesWithin::BoxesWithin(const std::vector<NodeBox>& boxes) {
  if (boxes.empty()) return;
  std::vector<int> order(boxes.size());
  std::iota(order.begin(), order.end(), 0);
  nodes_.reserve(2 * boxes.size());
  build(boxes, order, 0, boxes.size());
}

void BoxesWithin::build(const std::vector<NodeBox>& boxes, std::vector<int>& order,
                        std::size_t first, std::size_t last) {
  const std::size_t index = nodes_.size();
  nodes_.push_back({lowOf(boxes[order[first]]), highOf(boxes[order[first]]), 0, -1});
  for (std::size_t i = first; i < last; ++i) {
    Node& node = nodes_[index];
    node.highest_lo = node.highest_lo.cwiseMax(lowOf(boxes[order[i]]));
    node.lowest_hi = node.lowest_hi.cwiseMin(highOf(boxes[order[i]]));
  }
  if (last - first == 1) {
    nodes_[index].item = order[first];
  } else {
    const int axis = widestAxis(boxes, order, first, last);
    const std::size_t middle = first + (last - first) / 2;
    const auto at = [&order](std::size_t i) {
      return order.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(first), at(middle), at(last), [&](int a, int b) {
      return boxes[a].lo[axis] + boxes[a].hi[axis] < boxes[b].lo[axis] + boxes[b].hi[axis];
    });
    build(boxes, order, first, middle);
    build(boxes, order, middle, last);
  }
  nodes_[index].skip = static_cast<int>(nodes_.size());
}

}  // namespace fcl_prob::detail
