// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// GeneralPCD as a traversal node of FCL.
#pragma once

#include <fcl/narrowphase/detail/traversal/collision/bvh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>

#include "paper/pair_sum.h"

namespace fcl_prob::detail {

/// Algorithm 2 of the paper in FCL's own recursion: `fcl::detail::collide(&node)` walks both trees,
/// and a pair is pruned when its bound is small enough to be added to the sum.
template <typename BV>
class GeneralPcdTraversalNode final : public fcl::detail::BVHCollisionTraversalNode<BV> {
 public:
  GeneralPcdTraversalNode(const fcl::BVHModel<BV>& a, const fcl::BVHModel<BV>& b, PairSum& sum)
      : sum_(sum) {
    this->model1 = &a;
    this->model2 = &b;
  }

  /// True prunes. A pair is added here and never reaches leafTesting(), because a pair of leaves is
  /// not refined.
  bool BVTesting(int node_a, int node_b) const override {
    const double bound = sum_.bound(node_a, node_b);
    if (sum_.refines(node_a, node_b, bound)) return false;
    sum_.add(node_a, node_b, bound);
    return true;
  }

  void leafTesting(int, int) const override {}

  bool firstOverSecond(int node_a, int node_b) const override {
    return sum_.pairs().refinesA(node_a, node_b);
  }

  bool canStop() const override { return sum_.finished(); }

 private:
  PairSum& sum_;  // FCL's tests are const
};

}  // namespace fcl_prob::detail
