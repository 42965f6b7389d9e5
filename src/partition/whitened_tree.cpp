// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/whitened_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fcl_prob::detail {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
using LongVector = Eigen::Matrix<long double, 3, 1>;
using LongMatrix = Eigen::Matrix<long double, 3, 3>;

// The constant part of b - a - mean in the world frame, in extended precision: poses and origins
// may be large and nearly cancel.
LongVector relativeOrigin(const PieceTree& a, const fcl::Transform3d& pose_a, const PieceTree& b,
                          const fcl::Transform3d& pose_b, const Eigen::Vector3d& mean) {
  const auto origin = [](const PieceTree& tree, const fcl::Transform3d& pose) -> LongVector {
    const LongMatrix rotation = pose.linear().cast<long double>();
    return rotation * tree.origin.cast<long double>() + pose.translation().cast<long double>();
  };
  return origin(b, pose_b) - origin(a, pose_a) - mean.cast<long double>();
}

double largestRowSum(const Eigen::Matrix3d& m) { return m.cwiseAbs().rowwise().sum().maxCoeff(); }

// Boxes of the leaves from their vertices, then of the inner nodes from their children, which stand
// behind them.
void fitBoxes(WhitenedTree& whitened) {
  const PieceTree& tree = *whitened.tree;
  whitened.boxes.resize(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const PieceTree::Node& node = tree.nodes[i];
    NodeBox& box = whitened.boxes[i];
    if (!node.isLeaf()) {
      const NodeBox& left = whitened.boxes[node.left];
      const NodeBox& right = whitened.boxes[node.right];
      for (int k = 0; k < 3; ++k) {
        box.lo[k] = std::min(left.lo[k], right.lo[k]);
        box.hi[k] = std::max(left.hi[k], right.hi[k]);
      }
      continue;
    }
    Eigen::Vector3d lo = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Vector3d hi = -lo;
    const auto include = [&](int vertex) {
      lo = lo.cwiseMin(whitened.vertices[vertex]);
      hi = hi.cwiseMax(whitened.vertices[vertex]);
    };
    if (tree.isMesh()) {
      for (int corner = 0; corner < 3; ++corner) include(tree.triangles[node.piece][corner]);
    } else {
      const WhitenedShape& shape = whitened.shapes[tree.pieces[node.piece]];
      lo = whitened.vertices[node.piece] + shape.lo;
      hi = whitened.vertices[node.piece] + shape.hi;
    }
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = lo[k] - whitened.error;
      box.hi[k] = hi[k] + whitened.error;
    }
  }
}

WhitenedShape whitenShape(const PieceShape& shape, const Eigen::Matrix3d& linear) {
  WhitenedShape result{{shape.body.transformed(linear), {}, {}}, {}, {}};
  for (const auto& [p, q] : shape.faces) result.shape.faces.emplace_back(linear * p, linear * q);
  for (const Eigen::Vector3d& edge : shape.edges) result.shape.edges.push_back(linear * edge);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(k);
    result.lo[k] = -result.shape.body.supportValue(-axis);
    result.hi[k] = result.shape.body.supportValue(axis);
  }
  return result;
}

WhitenedTree whitenOne(const PieceTree& tree, const fcl::Transform3d& pose,
                       const Whitening& whitening, const Eigen::Vector3d& offset) {
  WhitenedTree result;
  result.tree = &tree;
  const Eigen::Matrix3d linear = whitening.matrix() * pose.linear();
  result.vertices.reserve(tree.vertices.size());
  for (const Eigen::Vector3d& v : tree.vertices) result.vertices.push_back(linear * v + offset);
  for (const PieceShape& shape : tree.shapes) result.shapes.push_back(whitenShape(shape, linear));
  const double size = largestRowSum(whitening.matrix()) * 1.8 * tree.radius;
  result.error = 16 * kEpsilon * (2 * size + offset.cwiseAbs().maxCoeff()) +
                 std::numeric_limits<double>::min();
  fitBoxes(result);
  return result;
}

}  // namespace

WhitenedPair whiten(const PieceTree& a, const fcl::Transform3d& pose_a, const PieceTree& b,
                    const fcl::Transform3d& pose_b, const Whitening& whitening) {
  const LongVector relative = relativeOrigin(a, pose_a, b, pose_b, whitening.mean());
  const Eigen::Vector3d offset = (whitening.matrix().cast<long double>() * relative).cast<double>();
  return {whitenOne(a, pose_a, whitening, Eigen::Vector3d::Zero()),
          whitenOne(b, pose_b, whitening, offset)};
}

}  // namespace fcl_prob::detail
