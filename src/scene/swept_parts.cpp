// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/swept_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace fcl_prob::detail {
namespace {

// Poses are rotations to 1e-9; sums of a few products of doubles are far closer than this.
constexpr double kNoRotation = 1e-8;
constexpr double kRoundedSums = 1e-12;

const PointMotion kUnmoved;

// Relative to the geometry's frame, in its axes.
Eigen::AlignedBox3d boxAround(const PieceTree& tree, const PieceTree::Part& part) {
  Eigen::AlignedBox3d box;
  for (int v = part.vertices.begin; v < part.vertices.end; ++v) {
    box.extend(part.origin + tree.vertices[v]);
  }
  for (int b = part.bodies.begin; b < part.bodies.end; ++b) {
    const PieceTree::Body& body = tree.bodies[b];
    const Eigen::Vector3d position = part.origin + body.position;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(k);
      const SupportShape& shape = tree.shapes[body.shape].body;
      Eigen::Vector3d corner = position;
      corner[k] += shape.supportValue(axis);
      box.extend(corner);
      corner[k] = position[k] - shape.supportValue(-axis);
      box.extend(corner);
    }
  }
  return box;
}

}  // namespace

SweptParts::SweptParts(const PartitionObject& object) {
  if (!object.isSwept()) return;
  const PieceTree& tree = *object.tree;
  part_of_node_.assign(tree.nodes.size(), -1);
  for (std::size_t i = 0; i < object.parts.size(); ++i) {
    parts_.push_back(boxed(tree, tree.parts[i], object.parts[i]));
    radius_of_several_ = std::max(radius_of_several_, radiusOf(parts_.back()));
    if (tree.parts[i].root < 0) continue;
    std::vector<int> below{tree.parts[i].root};
    while (!below.empty()) {
      const int node = below.back();
      below.pop_back();
      part_of_node_[static_cast<std::size_t>(node)] = static_cast<int>(i);
      const PieceTree::Node& opened = tree.nodes[static_cast<std::size_t>(node)];
      if (!opened.isLeaf()) below.insert(below.end(), {opened.left, opened.right});
    }
  }
}

SweptParts::Part SweptParts::boxed(const PieceTree& tree, const PieceTree::Part& part,
                                   const PlacedPart& placed) {
  Part result{placed.sweep ? placed.sweep : &kUnmoved, placed.pose.linear(),
              Eigen::Vector3d::Zero()};
  const Eigen::AlignedBox3d box = boxAround(tree, part);
  if (box.isEmpty()) return result;
  const Eigen::Vector3d centre =
      placed.pose.linear().transpose() * (result.sweep->centre - placed.pose.translation());
  const double size = box.min().norm() + box.max().norm() + centre.norm() +
                      result.sweep->centre.norm() + placed.pose.translation().norm();
  result.half = (box.max() - centre).cwiseAbs().cwiseMax((box.min() - centre).cwiseAbs());
  result.half.array() += kNoRotation * size + part.error;
  return result;
}

double SweptParts::alongPart(const Part& part, const Eigen::Vector3d& n) {
  const PointMotion& sweep = *part.sweep;
  double sum = n.norm() * (sweep.ball + sweep.remainder * part.half.norm());
  double size = sum;
  for (const Eigen::Vector3d& shift : sweep.shifts) {
    sum += std::fabs(n.dot(shift));
    size += n.norm() * shift.norm();
  }
  for (const Eigen::Vector3d& turn : sweep.turns) {
    // n·(turn × x) = (n × turn)·x
    const Eigen::Vector3d across = part.axes.transpose() * n.cross(turn);
    sum += across.cwiseAbs().dot(part.half);
    size += n.norm() * turn.norm() * part.half.norm();
  }
  return sum + kRoundedSums * size + std::numeric_limits<double>::min();
}

double SweptParts::radiusOf(const Part& part) {
  // The box's axes are orthogonal to 1e-9.
  return (1.0 + kNoRotation) * part.sweep->reach(part.half.norm());
}

double SweptParts::along(const Eigen::Vector3d& n, int node) const {
  if (parts_.empty()) return 0.0;
  const int part = part_of_node_[static_cast<std::size_t>(node)];
  if (part < 0) return (1.0 + kRoundedSums) * n.norm() * radius_of_several_;
  return alongPart(parts_[static_cast<std::size_t>(part)], n);
}

}  // namespace fcl_prob::detail
