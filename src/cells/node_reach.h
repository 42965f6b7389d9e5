// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How far a convex mesh's C-obstacles with whole nodes reach.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "scene/whitened_fan.h"
#include "scene/whitened_polygons.h"

namespace fcl_prob::detail {

/// P ⊕ the triangles of a node lies behind some planes along faces of P, which are parallel for all
/// nodes. All is certain: kept in floats, rounded outwards.
class NodeReach {
 public:
  // Measured on robot parts beside an arm.
  static constexpr int kFaces = 32;
  using Heights = Eigen::Array<float, kFaces, 1>;

  /// Of the nodes of `pieces`.
  NodeReach(const WhitenedFan& fan, const WhitenedPolygons& pieces);

  /// What no point of a box is below, along those normals.
  Heights lowestOf(const Eigen::Vector3d& middle, const Eigen::Vector3d& half) const;

  /// What no point of the box is above.
  Heights highestOf(const Eigen::Vector3d& middle, const Eigen::Vector3d& half) const;

  /// Whether P ⊕ the triangles of a node is clear of such a box.
  bool isClearOf(const Heights& lowest, int node) const {
    return (lowest - highest_[node]).maxCoeff() > 0.0F;
  }

  /// How far P ⊕ the triangles of a node reaches over some heights, at the least along those
  /// normals, about.
  float leastOver(const Heights& heights, int node) const {
    return (highest_[node] - heights).minCoeff();
  }

  /// Around P ⊕ the triangles of a node.
  const NodeBox& boxOf(int node) const { return boxes_[node]; }

  /// Bytes, of a tree of so many nodes.
  static std::size_t memoryOf(std::size_t nodes) {
    return nodes * (sizeof(Heights) + sizeof(NodeBox));
  }

 private:
  using Places = Eigen::Array<double, kFaces, 1>;

  Places along(const Eigen::Vector3d& y) const;
  Places widthsOf(const Eigen::Vector3d& half) const;

  /// 0 where there are not so many: there nodes reach up to infinity.
  Eigen::Matrix<double, kFaces, 3> normals_;
  double rounding_;
  std::vector<Heights> highest_;  ///< by node
  std::vector<NodeBox> boxes_;    ///< by node
};

}  // namespace fcl_prob::detail
