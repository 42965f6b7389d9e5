// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How far a convex mesh's C-obstacles with whole nodes reach.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "pieces/patched_mesh.h"
#include "pieces/whitened_fan.h"

namespace fcl_prob::detail {

/// P ⊕ the triangles of a node lies behind some planes along faces of P, which are parallel for all
/// nodes. All is certain: kept in floats, rounded outwards.
class NodeReach {
 public:
  // Measured on robot parts beside an arm.
  static constexpr int kFaces = 32;
  using Heights = Eigen::Array<float, kFaces, 1>;

  /// Of the nodes of `pieces`.
  NodeReach(const WhitenedFan& fan, const PatchedMesh& pieces);

  /// What no point of a box is below, along those normals.
  Heights lowestOf(const Eigen::Vector3d& middle, const Eigen::Vector3d& half) const;

  /// Whether P ⊕ the triangles of a node is clear of such a box.
  bool isClearOf(const Heights& lowest, int node) const {
    return (lowest - highest_[node]).maxCoeff() > 0.0F;
  }

  /// How far P ⊕ the triangles of a node reaches over what no point of a box is below, at the least
  /// along those normals, about.
  float leastOver(const Heights& lowest, int node) const {
    return (highest_[node] - lowest).minCoeff();
  }

  /// Bytes, of a tree of so many nodes.
  static std::size_t memoryOf(std::size_t nodes) { return nodes * sizeof(Heights); }

 private:
  std::vector<Eigen::Vector3d> normals_;
  double rounding_;
  std::vector<Heights> highest_;  ///< by node
};

}  // namespace fcl_prob::detail
