// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How far the nodes of a mesh reach in a direction.
#pragma once

#include <optional>
#include <vector>

#include "base/kept_memory.h"
#include "scene/whitened_tree.h"

namespace fcl_prob::detail {

/// Support values of nodes along one direction at a time, remembered until it changes.
class NodeSupport {
 public:
  /// Keeps a reference to `mesh`.
  explicit NodeSupport(const WhitenedTree& mesh);

  /// The largest m·v over the vertices v under `node`; the mesh's error is not added.
  double along(const Eigen::Vector3d& m, int node);

 private:
  static constexpr int kNone = -1;

  /// What is known of a node.
  struct Known {
    double value;
    unsigned direction;  ///< the number of the direction for which `value` was found
  };
  /// A node to be looked at.
  struct Reach {
    int node;
    int parent;    ///< in `opened_`
    double bound;  ///< of its box
  };
  /// A node of which the children were looked at.
  struct Opened {
    int node;
    int parent;
  };

  double search(int node);
  std::optional<double> ofFew(int node) const;
  double ofCluster(int node) const;
  double ofTriangles(const PieceTree::Node& node) const;
  const double* valueOf(int node) const;
  void note(int node, double value);

  const WhitenedTree* mesh_;
  Eigen::Vector3d m_;
  unsigned direction_ = 0;
  /// By node, in `known_`; empty until the first search.
  std::vector<int, KeptMemory<int>> places_;
  std::vector<Known, KeptMemory<Known>> known_;
  std::vector<Reach> stack_;
  std::vector<Opened> opened_;  ///< by the search
};

}  // namespace fcl_prob::detail
