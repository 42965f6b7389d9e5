// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How far the nodes of a mesh reach in a direction.
#pragma once

#include <vector>

#include "pieces/whitened_tree.h"

namespace fcl_prob::detail {

/// Support values of nodes along one direction at a time, remembered until it changes.
class NodeSupport {
 public:
  /// Keeps a reference to `mesh`.
  explicit NodeSupport(const WhitenedTree& mesh);

  /// The largest m·v over the vertices v under `node`; the mesh's error is not added.
  double along(const Eigen::Vector3d& m, int node);

 private:
  /// What is known of a node.
  struct Known {
    double value = 0.0;
    unsigned direction = 0;  ///< the number of the direction for which `value` was found
    int parent = -1;
  };
  struct Reach {
    int node;
    double bound;  ///< of its box
  };

  void prepare();
  double search(int node);
  double ofTriangles(const PieceTree::Node& node) const;
  bool isKnown(int node) const { return known_[node].direction == direction_; }
  void note(int node, double value);

  const WhitenedTree* mesh_;
  Eigen::Vector3d m_;
  unsigned direction_ = 0;
  std::vector<Known> known_;  ///< by node; empty until the first search
  std::vector<Reach> stack_;
};

}  // namespace fcl_prob::detail
