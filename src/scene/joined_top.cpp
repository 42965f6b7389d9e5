// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/joined_top.h"

namespace fcl_prob::detail {

JoinedTop::JoinedTop(const std::vector<const PieceTree*>& trees,
                     const std::vector<fcl::Transform3d>& poses)
    : trees_(trees), poses_(poses) {
  const std::vector<Row> all = rows();
  if (!all.empty()) halves(all, 0, all.size());
}

bool JoinedTop::mayBeInterwoven(const PieceTree& tree) const {
  return !poses_.empty() && tree.isMesh() && tree.parts.size() == 1;
}

std::vector<JoinedTop::Row> JoinedTop::rows() const {
  std::vector<Row> rows;
  for (int i = 0; i < static_cast<int>(trees_.size()); ++i) {
    if (trees_[i]->isEmpty()) continue;
    const bool goes_on = !rows.empty() && rows.back().last == i - 1 && trees_[i] == trees_[i - 1] &&
                         mayBeInterwoven(*trees_[i]);
    if (goes_on) {
      rows.back().last = i;
    } else {
      rows.push_back({i, i});
    }
  }
  return rows;
}

JoinedTop::Place JoinedTop::halves(const std::vector<Row>& rows, std::size_t begin,
                                   std::size_t end) {
  if (end - begin == 1) {
    const Row& row = rows[begin];
    if (row.first == row.last) return {row.first, 0};
    return interwoven(boxesOf(*trees_[row.first]), 0, row);
  }
  const std::size_t middle = (begin + end) / 2;
  const std::size_t at = nodes_.size();
  nodes_.emplace_back();
  const Place left = halves(rows, begin, middle);
  const Place right = halves(rows, middle, end);
  nodes_[at] = {left, right};
  return {Place::kTop, static_cast<int>(at)};
}

JoinedTop::Place JoinedTop::interwoven(const Boxes& boxes, int node, const Row& row) {
  if (row.first == row.last) return {row.first, node};
  const PieceTree::Node& own = trees_[row.first]->nodes[node];
  const std::size_t at = nodes_.size();
  nodes_.emplace_back();
  Node parent;
  if (own.isLeaf() || movesFar(boxes, node, row)) {
    const int middle = (row.first + row.last) / 2;
    parent.left = interwoven(boxes, node, {row.first, middle});
    parent.right = interwoven(boxes, node, {middle + 1, row.last});
  } else {
    parent.left = interwoven(boxes, own.left, row);
    parent.right = interwoven(boxes, own.right, row);
  }
  nodes_[at] = parent;
  return {Place::kTop, static_cast<int>(at)};
}

// Farther than it is large. Of ways there and back no more than the ends count, which costs time
// only.
bool JoinedTop::movesFar(const Boxes& boxes, int node, const Row& row) const {
  const Eigen::AlignedBox3d& box = boxes[node];
  const Eigen::Vector3d middle = trees_[row.first]->parts[0].origin + box.center();
  const Eigen::Vector3d way = poses_[row.first] * middle - poses_[row.last] * middle;
  return way.squaredNorm() > box.diagonal().squaredNorm();
}

const JoinedTop::Boxes& JoinedTop::boxesOf(const PieceTree& tree) {
  Boxes& boxes = boxes_[&tree];
  if (!boxes.empty()) return boxes;
  boxes.resize(tree.nodes.size());
  // Children stand behind their parents.
  for (std::size_t i = boxes.size(); i-- > 0;) {
    const PieceTree::Node& node = tree.nodes[i];
    if (!node.isLeaf()) {
      boxes[i] = boxes[node.left].merged(boxes[node.right]);
      continue;
    }
    for (const int v : tree.triangles[node.piece]) boxes[i].extend(tree.vertices[v]);
  }
  return boxes;
}

}  // namespace fcl_prob::detail
