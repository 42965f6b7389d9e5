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
  struct Reach {
    int node;
    double bound;  ///< of its box
  };

  void prepare();
  double search(int node);
  double ofLeaf(const Eigen::Vector3d& m, int leaf) const;
  bool isKnown(int node) const { return known_in_[node] == direction_; }
  void note(int node, double value);

  const WhitenedTree* mesh_;
  Eigen::Vector3d m_;
  std::vector<int> parent_;  ///< of each node; empty until the first search
  std::vector<double> value_;
  std::vector<unsigned> known_in_;  ///< by node: the direction's number for which value_ was found
  unsigned direction_ = 1;
  std::vector<Reach> stack_;
};

}  // namespace fcl_prob::detail
