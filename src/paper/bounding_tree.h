// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Trees of convex bodies, whatever they are made of.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "convex/bounding_volumes.h"
#include "convex/convex_set.h"
#include "fcl_prob/convex_body.h"
#include "geometry/length.h"

namespace fcl_prob::detail {

using ConvexSetPtr = std::unique_ptr<const ConvexSet>;

inline ConvexSetPtr makeBody(const RoundedZonotope& body) {
  return std::make_unique<const ConvexSet>(body, ConvexBody::kDefaultResolution);
}
inline ConvexSetPtr makeBody(ConvexMesh mesh) {
  return std::make_unique<const ConvexSet>(std::move(mesh));
}

template <typename BV>
ConvexSetPtr bodyOf(const BV& volume) {
  return makeBody(roundedZonotope(volume));
}
template <std::size_t N>
ConvexSetPtr bodyOf(const fcl::KDOP<double, N>& dop) {
  return makeBody(meshOfSlabs(slabsOf(dop)));
}
inline ConvexSetPtr bodyOf(const Kdop26& dop) { return makeBody(meshOfSlabs(slabsOf(dop))); }

/// A binary tree of nested convex bodies over the pieces of a geometry, in its frame. Node 0 is the
/// root. Bodies are made when they are first asked for: not for concurrent use.
class BoundingTree {
 public:
  virtual ~BoundingTree() = default;

  /// The left child, or a negative number for a leaf. The right child is the next node.
  virtual int leftChild(int node) const = 0;
  bool isLeaf(int node) const { return leftChild(node) < 0; }

  virtual double volume(int node) const = 0;

  /// The bounding body of a node, and the piece itself of a leaf.
  virtual const ConvexSet& body(int node) const = 0;
  virtual const ConvexSet& piece(int leaf) const = 0;

  /// No coordinate of a body is larger than this, metres.
  virtual double size() const = 0;

  /// No body reaches out of its polytope by more than this, metres.
  virtual double slack() const { return 0.0; }
};

/// The tree of a finished mesh, which must outlive it.
template <typename BV>
class ModelTree final : public BoundingTree {
 public:
  explicit ModelTree(const fcl::BVHModel<BV>& model)
      : model_(model), bodies_(model.getNumBVs()), pieces_(model.getNumBVs()) {}

  const fcl::BVHModel<BV>& model() const { return model_; }

  int leftChild(int node) const override {
    return model_.getBV(node).isLeaf() ? -1 : model_.getBV(node).leftChild();
  }
  double volume(int node) const override { return model_.getBV(node).bv.volume(); }

  const ConvexSet& body(int node) const override {
    if (!bodies_[node]) bodies_[node] = bodyOf(model_.getBV(node).bv);
    return *bodies_[node];
  }

  const ConvexSet& piece(int leaf) const override {
    if (!pieces_[leaf]) {
      const fcl::Triangle& triangle = model_.tri_indices[model_.getBV(leaf).primitiveId()];
      pieces_[leaf] =
          makeBody(makeTriangle(model_.vertices[triangle[0]], model_.vertices[triangle[1]],
                                model_.vertices[triangle[2]]));
    }
    return *pieces_[leaf];
  }

  double size() const override {
    double largest = 0.0;
    for (int i = 0; i < model_.num_vertices; ++i) {
      largest = std::max(largest, lengthOf(model_.vertices[i]));
    }
    return kReach * largest;
  }

 private:
  /// Bounding volumes reach beyond the vertices, but not by much.
  static constexpr double kReach = 4.0;

  const fcl::BVHModel<BV>& model_;
  mutable std::vector<ConvexSetPtr> bodies_;
  mutable std::vector<ConvexSetPtr> pieces_;
};

/// One convex shape as a tree of one node.
class ShapeTree final : public BoundingTree {
 public:
  explicit ShapeTree(const fcl::CollisionGeometryd& shape) : body_(shape) {}

  int leftChild(int) const override { return -1; }
  double volume(int) const override { return 0.0; }  // never compared: a leaf is not refined
  const ConvexSet& body(int) const override { return body_.set(); }
  const ConvexSet& piece(int) const override { return body_.set(); }
  double size() const override { return body_.set().size(); }
  double slack() const override { return body_.set().slack(); }

 private:
  ConvexBody body_;
};

}  // namespace fcl_prob::detail
