// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "paper/node_pairs.h"

#include "bounds/convex_bound.h"
#include "convex/pair_obstacle.h"

namespace fcl_prob::detail {

double NodePairs::bound(int node_a, int node_b) {
  return least(*PairObstacle(frame_, a_.body(node_a), b_.body(node_b)));
}

double NodePairs::pieceBound(int leaf_a, int leaf_b) {
  return least(*PairObstacle(frame_, a_.piece(leaf_a), b_.piece(leaf_b)));
}

double NodePairs::least(const CObstacle& obstacle) {
  if (negligible_ > 0.0) {
    const double upper = halfSpaceUpper(obstacle);
    if (upper < negligible_) return upper;
  }
  return pair_bounds_.bounds(obstacle, enough_).least;
}

bool NodePairs::refinesA(int node_a, int node_b) const {
  if (b_.isLeaf(node_b)) return true;
  return !a_.isLeaf(node_a) && a_.volume(node_a) >= b_.volume(node_b);
}

std::array<NodePair, 2> NodePairs::children(int node_a, int node_b) const {
  if (refinesA(node_a, node_b)) {
    const int left = a_.leftChild(node_a);
    return {NodePair{left, node_b}, NodePair{left + 1, node_b}};
  }
  const int left = b_.leftChild(node_b);
  return {NodePair{node_a, left}, NodePair{node_a, left + 1}};
}

}  // namespace fcl_prob::detail
