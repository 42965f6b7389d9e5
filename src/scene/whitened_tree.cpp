// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/whitened_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "geometry/exact_sum.h"

namespace fcl_prob::detail {

namespace {

using LongMatrix = Eigen::Matrix<long double, 3, 3>;

// Of the products that an exact sum of positions is made of, what they lose below the smallest
// number.
constexpr double kLostInProducts = 32 * std::numeric_limits<double>::denorm_min();

NodeBox boxOf(const SupportShape& body) {
  NodeBox box;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(k);
    box.lo[k] = -body.supportValue(-axis);
    box.hi[k] = body.supportValue(axis);
  }
  return box;
}

/// The middle of a part relative to the origin of a whitened frame.
struct PartOffset {
  Eigen::Vector3d whitened;
  Eigen::Vector3d reach;  ///< bound on the terms that the coordinates are sums of: they may cancel
};

// The difference of far positions is exact, so that no bound need know how far they are.
PartOffset partOffset(const PieceTree::Part& part, const fcl::Transform3d& pose,
                      const Whitening& whitening, const ExactPosition& minus_origin) {
  ExactPosition position = minus_origin;
  position.add(pose, part.origin);
  const LongVector offset = position.value();
  const LongMatrix matrix = whitening.matrix().cast<long double>();
  return {(matrix * offset).cast<double>(), (matrix.cwiseAbs() * offset.cwiseAbs()).cast<double>()};
}

void whitenPart(const PieceTree::Part& part, const Eigen::Matrix3d& whitening,
                const Eigen::Matrix3d& rotation, const Eigen::Vector3d& offset,
                WhitenedTree& result) {
  const PieceTree& tree = *result.tree;
  const Eigen::Matrix3d linear = whitening * rotation;
  result.linear.push_back(linear);
  result.offsets.push_back(offset);
  const Eigen::Matrix3d magnitudes = whitening.cwiseAbs() * rotation.cwiseAbs();
  for (int i = part.vertices.begin; i < part.vertices.end; ++i) {
    result.vertices.push_back(linear * tree.vertices[i] + offset);
  }
  for (int i = part.bodies.begin; i < part.bodies.end; ++i) {
    result.positions.push_back(linear * tree.bodies[i].position + offset);
  }
  for (int i = part.shapes.begin; i < part.shapes.end; ++i) {
    result.shapes.push_back(tree.shapes[i].mapped(linear, magnitudes));
    result.shape_boxes.push_back(boxOf(result.shapes.back().body));
  }
}

// What is swept by a ball, radius 0 included, turns as its centres do: the largest motion of those.
// A pose that is not quite a rotation makes an ellipsoid of the ball, which turns by what it is
// off.
Eigen::Vector3d motionOfRoundBody(const PointMotion& motion, const Eigen::Matrix3d& whitening,
                                  const fcl::Transform3d& pose, const Eigen::Vector3d& position,
                                  const SupportShape& body) {
  Eigen::Vector3d largest = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& centre : body.points) {
    largest = largest.cwiseMax(motion.bound(whitening, pose * Eigen::Vector3d(position + centre)));
  }
  const Eigen::Matrix3d& linear = pose.linear();
  const double off = (linear.transpose() * linear - Eigen::Matrix3d::Identity()).norm();
  const double changed = body.semi_axes(0, 0) * (2.0 * off + 16 * kEpsilon);
  return largest + changed * whitening.rowwise().norm();
}

bool isRound(const SupportShape& body) {
  const double radius = body.semi_axes(0, 0);
  return body.semi_axes == Eigen::Matrix3d(Eigen::Vector3d::Constant(radius).asDiagonal());
}

// The largest motion of the corners of a box around a body.
Eigen::Vector3d motionOfBody(const PointMotion& motion, const Eigen::Matrix3d& whitening,
                             const fcl::Transform3d& pose, const Eigen::Vector3d& position,
                             const SupportShape& body) {
  if (isRound(body)) return motionOfRoundBody(motion, whitening, pose, position, body);
  Eigen::Vector3d lo, hi;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(k);
    lo[k] = position[k] - body.supportValue(-axis);
    hi[k] = position[k] + body.supportValue(axis);
  }
  Eigen::Vector3d largest = Eigen::Vector3d::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector3d point;
    for (int k = 0; k < 3; ++k) point[k] = (corner >> k) % 2 == 0 ? lo[k] : hi[k];
    largest = largest.cwiseMax(motion.bound(whitening, pose * point));
  }
  return largest;
}

const PointMotion& motionOfPart(const PartitionObject& object, std::size_t part) {
  static const PointMotion unmoved;
  if (object.parts[part].sweep) return *object.parts[part].sweep;
  return object.motion ? *object.motion : unmoved;
}

// Of every vertex, and of the pieces of every node.
void boundMotions(const PartitionObject& object, const Eigen::Matrix3d& whitening,
                  WhitenedTree& result) {
  result.vertex_motions.clear();
  result.node_motions.clear();
  if (!object.motion && !object.isSwept()) return;
  const PieceTree& tree = *object.tree;
  std::vector<Eigen::Vector3d> of_bodies;
  for (std::size_t i = 0; i < object.parts.size(); ++i) {
    const PieceTree::Part& part = tree.parts[i];
    const fcl::Transform3d& pose = object.parts[i].pose;
    const PointMotion& motion = motionOfPart(object, i);
    for (int v = part.vertices.begin; v < part.vertices.end; ++v) {
      result.vertex_motions.push_back(
          motion.bound(whitening, pose * Eigen::Vector3d(part.origin + tree.vertices[v])));
    }
    for (int b = part.bodies.begin; b < part.bodies.end; ++b) {
      const PieceTree::Body& body = tree.bodies[b];
      of_bodies.push_back(motionOfBody(motion, whitening, pose, part.origin + body.position,
                                       tree.shapes[body.shape].body));
    }
  }
  result.node_motions.resize(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const PieceTree::Node& node = tree.nodes[i];
    Eigen::Vector3d& motion = result.node_motions[i];
    if (!node.isLeaf()) {
      motion = result.node_motions[node.left].cwiseMax(result.node_motions[node.right]);
    } else if (tree.isTriangle(node.piece)) {
      const Eigen::Vector3i& t = tree.triangles[node.piece];
      motion = result.vertex_motions[t[0]]
                   .cwiseMax(result.vertex_motions[t[1]])
                   .cwiseMax(result.vertex_motions[t[2]]);
    } else {
      motion = of_bodies[tree.bodyOf(node.piece)];
    }
  }
}

void whitenOne(const PartitionObject& object, const Whitening& whitening,
               const ExactPosition& minus_origin, double moved, WhitenedTree& result) {
  result.tree = object.tree;
  result.vertices.clear();
  result.linear.clear();
  result.offsets.clear();
  result.positions.clear();
  result.shapes.clear();
  result.shape_boxes.clear();
  result.vertices.reserve(object.tree->vertices.size());
  Eigen::Vector3d farthest = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < object.parts.size(); ++i) {
    const PieceTree::Part& part = object.tree->parts[i];
    const fcl::Transform3d& pose = object.parts[i].pose;
    const PartOffset offset = partOffset(part, pose, whitening, minus_origin);
    whitenPart(part, whitening.matrix(), pose.linear(), offset.whitened, result);
    farthest = farthest.cwiseMax(offset.reach);
  }
  const Eigen::Vector3d stretch = whitening.matrix().cwiseAbs().rowwise().sum();
  const Eigen::Vector3d size = 1.8 * object.tree->radius() * stretch;
  // A whitened coordinate is a sum of products with the pose and the matrix: 16 ε of the magnitudes
  // of all terms is more than two such sums in turn round. Axis by axis, since whitening may
  // stretch one axis by 1e12 of another.
  result.error = 16 * kEpsilon * (2 * size + farthest) +
                 (object.tree->error() + kLostInProducts + moved) * stretch;
  result.error.array() += std::numeric_limits<double>::min();
  boundMotions(object, whitening.matrix(), result);
  result.boxes.fit(result);
}

}  // namespace

NodeBox bodyBox(const WhitenedTree& whitened, int body) {
  const NodeBox& box = whitened.shape_boxes[whitened.tree->bodies[body].shape];
  const Eigen::Vector3d& position = whitened.positions[body];
  return paddedBox(position + Eigen::Map<const Eigen::Vector3d>(box.lo),
                   position + Eigen::Map<const Eigen::Vector3d>(box.hi), whitened.error);
}

void whiten(const PartitionObject& a, const PartitionObject& b, const Whitening& whitening,
            WhitenedPair& result, double moved) {
  ExactPosition minus_origin;
  minus_origin.add(a.parts[0].pose, a.tree->parts[0].origin, -1.0);
  whitenOne(a, whitening, minus_origin, 0.0, result.a);
  minus_origin.add(whitening.mean(), -1.0);
  whitenOne(b, whitening, minus_origin, moved, result.b);
}

WhitenedPair whiten(const PartitionObject& a, const PartitionObject& b,
                    const Whitening& whitening) {
  WhitenedPair result;
  whiten(a, b, whitening, result);
  return result;
}

std::array<NodePair, 2> childrenOf(const WhitenedPair& pair, NodePair nodes) {
  const PieceTree::Node& a = pair.a.tree->nodes[nodes.a];
  const PieceTree::Node& b = pair.b.tree->nodes[nodes.b];
  const bool split_a =
      b.isLeaf() || (!a.isLeaf() && pair.a.boxOf(nodes.a).size() >= pair.b.boxOf(nodes.b).size());
  if (split_a) return {NodePair{a.left, nodes.b}, NodePair{a.right, nodes.b}};
  return {NodePair{nodes.a, b.left}, NodePair{nodes.a, b.right}};
}

}  // namespace fcl_prob::detail
