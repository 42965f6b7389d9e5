// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Nodes of a mesh that are flat: between two planes along their surface, which a box along the axes
// knows nothing of.
#pragma once

#include <Eigen/Core>
#include <mutex>
#include <vector>

#include "scene/piece_tree.h"

namespace fcl_prob::detail {

/// A node between two planes, for whatever pose: lo <= normal·x <= hi for all its points x, in the
/// axes of its part, relative to its origin. Rounded outwards; the normal is taken as it is.
struct NodeSlab {
  Eigen::Vector3f normal =
      Eigen::Vector3f::Zero();  ///< about a unit vector; 0: the node is not flat
  float lo = 0.0F;              ///< metres
  float hi = 0.0F;              ///< metres

  bool isFlat() const { return normal != Eigen::Vector3f::Zero(); }
};

/// Of all nodes of one mesh, made when they are first asked for, by any of several threads.
class SlabsOfNodes {
 public:
  /// By number of the node, less that of the part's root.
  /// \param part  of `tree`, a mesh: the same one in all calls, in whatever tree
  const std::vector<NodeSlab>& of(const PieceTree& tree, const PieceTree::Part& part) const;

 private:
  mutable std::once_flag once_;
  mutable std::vector<NodeSlab> made_;
};

}  // namespace fcl_prob::detail
