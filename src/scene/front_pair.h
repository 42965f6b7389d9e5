// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What the front of a cell consists of.
#pragma once

#include "scene/whitened_tree.h"

namespace fcl_prob::detail {

/// What may meet a cell: the C-obstacle of two nodes, one of them inner; that of two leaves; or a
/// layer between two planes, one of them perhaps at infinity, of which the part within the cell is
/// known to collide, whatever pairs cause that.
struct FrontPair {
  static FrontPair ofNodes(NodePair nodes) { return {nodes, kNone}; }
  static FrontPair ofLeaves(NodePair leaves, int obstacle) { return {leaves, obstacle}; }
  static FrontPair ofLayer(int obstacle) { return {{kNone, kNone}, obstacle}; }

  /// Whether it has planes in the ObstacleTable: all have but pairs with an inner node.
  bool hasObstacle() const { return obstacle != kNone; }
  bool isLayer() const { return nodes.a == kNone; }

  static constexpr int kNone = -1;
  NodePair nodes;
  int obstacle;  ///< its index in the ObstacleTable
};

}  // namespace fcl_prob::detail
