// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// ConvexPCD for the pairs of nodes of two bounding volume trees.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "bounds/pair_bounds.h"
#include "convex/pair_frame.h"
#include "geometry/node_pair.h"
#include "paper/bounding_tree.h"

namespace fcl_prob::detail {

/// Bounds pairs of nodes by the structure of their bodies. Not for concurrent use.
class NodePairs {
 public:
  NodePairs(const BoundingTree& a, const BoundingTree& b, const PairFrame& frame)
      : a_(a), b_(b), frame_(frame) {}
  virtual ~NodePairs() = default;

  const BoundingTree& a() const { return a_; }
  const BoundingTree& b() const { return b_; }

  /// Upper bound on the probability that what two nodes contain touches; 1 if it is seen early that
  /// the bound would be at least enough().
  virtual double bound(int node_a, int node_b);

  /// A bound of at least this need not be exact (pairs that will be refined anyway).
  void setEnough(double bound) { enough_ = bound; }

  /// GeneralPcdRequest::negligible.
  void setNegligible(double bound) { negligible_ = bound; }

  /// The same for two leaves by the pieces themselves.
  double pieceBound(int leaf_a, int leaf_b);

  /// Whether the node of A is refined next, if not that of B: the larger one, unless it is a leaf.
  bool refinesA(int node_a, int node_b) const;

  /// The two pairs that a pair, not of two leaves, is refined to.
  std::array<NodePair, 2> children(int node_a, int node_b) const;

  bool areLeaves(int node_a, int node_b) const { return a_.isLeaf(node_a) && b_.isLeaf(node_b); }

 protected:
  const PairFrame& frame() const { return frame_; }
  double least(const CObstacle& obstacle);

 private:
  const BoundingTree& a_;
  const BoundingTree& b_;
  const PairFrame& frame_;
  double enough_ = PairBounds::kNeverEnough;
  double negligible_ = 0.0;
  PairBounds pair_bounds_;
};

/// Boxes, spheres and their like, straight from FCL's nodes.
template <typename BV>
class RoundedNodePairs : public NodePairs {
 public:
  RoundedNodePairs(const ModelTree<BV>& a, const ModelTree<BV>& b, const PairFrame& frame)
      : NodePairs(a, b, frame), model_a_(a.model()), model_b_(b.model()) {}

  double bound(int node_a, int node_b) override {
    return least(ZonotopeObstacle(frame(), roundedZonotope(volumeA(node_a)),
                                  roundedZonotope(volumeB(node_b))));
  }

 protected:
  const BV& volumeA(int node) const { return model_a_.getBV(node).bv; }
  const BV& volumeB(int node) const { return model_b_.getBV(node).bv; }

 private:
  const fcl::BVHModel<BV>& model_a_;
  const fcl::BVHModel<BV>& model_b_;
};

/// A kIOS is bounded both by its OBB and by its smallest sphere.
class KiosNodePairs final : public RoundedNodePairs<fcl::kIOSd> {
 public:
  using RoundedNodePairs::RoundedNodePairs;

  double bound(int node_a, int node_b) override {
    const double of_boxes = RoundedNodePairs::bound(node_a, node_b);
    const double of_spheres = least(ZonotopeObstacle(frame(), smallestSphere(volumeA(node_a)),
                                                     smallestSphere(volumeB(node_b))));
    return std::min(of_boxes, of_spheres);
  }
};

/// k-DOPs of two geometries that are not rotated against each other: slabs are added. (Otherwise
/// their polytopes are, by NodePairs itself.)
template <typename BV>
class SlabNodePairs final : public NodePairs {
 public:
  SlabNodePairs(const ModelTree<BV>& a, const ModelTree<BV>& b, const PairFrame& frame)
      : NodePairs(a, b, frame), model_a_(a.model()), model_b_(b.model()) {}

  double bound(int node_a, int node_b) override {
    setToSlabsOf(model_a_.getBV(node_a).bv, scratch_.slabs_a);
    setToSlabsOf(model_b_.getBV(node_b).bv, scratch_.slabs);
    addReversed(scratch_.slabs_a, scratch_.slabs);
    return least(SlabObstacle(frame(), scratch_));
  }

 private:
  const fcl::BVHModel<BV>& model_a_;
  const fcl::BVHModel<BV>& model_b_;
  SlabScratch scratch_;
};

}  // namespace fcl_prob::detail
