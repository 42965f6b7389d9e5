// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/turning_margin.h"

#include <algorithm>

#include "scene/whitened_tree.h"
#include "scene/widen_slabs.h"

namespace fcl_prob::detail {
namespace {

// More than a hundred times what sums of a few dozen products are rounded by.
constexpr double kRoundedTurns = 1e-12;

}  // namespace

TurningMargin::TurningMargin(const PartitionObject& a, const PartitionObject& b,
                             const Eigen::Matrix3d& whitening)
    : a_(sideOf(a)), b_(sideOf(b)), metres_(whitening.transpose()) {}

TurningMargin::Side TurningMargin::sideOf(const PartitionObject& object) {
  Side side{object.tree, {}, object.motion != nullptr, {}, {}};
  if (!side.moves) return side;
  side.motion = *object.motion;
  side.vertices.reserve(object.tree->vertices.size());
  for (std::size_t i = 0; i < object.parts.size(); ++i) {
    const PieceTree::Part& part = object.tree->parts[i];
    for (int v = part.vertices.begin; v < part.vertices.end; ++v) {
      side.vertices.push_back(object.parts[i].pose *
                              Eigen::Vector3d(part.origin + object.tree->vertices[v]));
    }
  }
  side.boxes.resize(object.tree->nodes.size());
  // Children stand behind their parents.
  for (std::size_t i = side.boxes.size(); i-- > 0;) {
    const PieceTree::Node& node = object.tree->nodes[i];
    if (!node.isLeaf()) {
      side.boxes[i] = side.boxes[node.left].merged(side.boxes[node.right]);
    } else if (object.tree->isTriangle(node.piece)) {
      for (const int v : object.tree->triangles[node.piece]) side.boxes[i].extend(side.vertices[v]);
    }
  }
  return side;
}

double TurningMargin::along(const Side& side, const Eigen::Vector3d& n, int node) {
  if (!side.moves) return 0.0;
  const PieceTree::Node& of_tree = side.tree->nodes[node];
  double largest = 0.0;
  if (of_tree.isLeaf()) {
    for (const int v : side.tree->triangles[of_tree.piece]) {
      largest = std::max(largest, side.motion.along(n, side.vertices[v]));
    }
    return largest;
  }
  // Turn by turn, which is more than corner by corner, and quicker: n·(turn × x) = (n × turn)·x.
  const Eigen::AlignedBox3d& box = side.boxes[node];
  const Eigen::Vector3d half = 0.5 * (box.max() - box.min());
  double sum = side.motion.along(n, 0.5 * box.min() + 0.5 * box.max());
  for (const Eigen::Vector3d& turn : side.motion.turns) sum += n.cross(turn).cwiseAbs().dot(half);
  return (sum + side.motion.remainder * n.norm() * half.norm()) * (1.0 + kRoundedTurns);
}

double TurningMargin::along(const Eigen::Vector3d& m, NodePair nodes) const {
  const Eigen::Vector3d n = metres_ * m;
  // What the normal itself is rounded by is within what the motion allows for its sums.
  return (1.0 + kRoundedTurns) * (along(a_, n, nodes.a) + along(b_, n, nodes.b));
}

void TurningMargin::widen(double* data, int count, NodePair leaves) const {
  widenSlabs(data, count, [&](const Eigen::Vector3d& m) {
    const double d = along(m, leaves);
    return SlabShift{d, d};
  });
}

}  // namespace fcl_prob::detail
