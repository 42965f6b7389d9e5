// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What random turns of two objects do to the C-obstacles of their triangles.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "convex/slab_kernels.h"
#include "scene/partition_object.h"
#include "scene/whitened_tree.h"

namespace fcl_prob::detail {

/// Along a plane's normal a point moves less than along the axes of the cells added up: a turn
/// about the normal itself does not move it. The C-obstacle V' of two triangles that are moved,
/// each by a rigid motion of its set, is convex, and along m it reaches beyond V, or less far, by
/// d(m) at most, d being the largest of the corners' sums, a support function. So V' lies within
/// the slabs of V, each moved outwards by d of its normal, and it contains those moved inwards: a
/// point beyond V' along m, m = Σ a_i n_i being a sum of the normals n_i of facets that meet where
/// V is extreme, would have m·y > h(m) - d(m) >= Σ a_i (h(n_i) - d(n_i)), and so be beyond one of
/// them.
class TurningMargin {
 public:
  /// Keeps references. What moves must be meshes. \param whitening  W
  TurningMargin(const PartitionObject& a, const PartitionObject& b,
                const Eigen::Matrix3d& whitening);

  /// By how much the C-obstacle of two nodes of meshes grows, or shrinks, along a whitened
  /// direction (any length) at most, rounded up.
  double along(const Eigen::Vector3d& m, NodePair nodes) const;

  /// Moves the slabs of two triangles outwards, and adds to their margins what the inside shrinks
  /// by.
  void widen(double* data, int count, NodePair leaves) const;

 private:
  /// An object that moves, in the world frame.
  struct Side {
    const PieceTree* tree;
    PointMotion motion;
    bool moves;
    std::vector<Eigen::Vector3d> vertices;
    std::vector<Eigen::AlignedBox3d> boxes;  ///< around the triangles of nodes
  };

  static Side sideOf(const PartitionObject& object);
  static double along(const Side& side, const Eigen::Vector3d& n, int node);

  Side a_;
  Side b_;
  Eigen::Matrix3d metres_;  ///< maps normals in the whitened frame to normals in metres
};

}  // namespace fcl_prob::detail
