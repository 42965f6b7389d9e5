// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/general_pcd.h"

#include <string>
#include <type_traits>

#include "fcl_prob/exceptions.h"
#include "geometry/geometry_kind.h"
#include "geometry/mesh_visitor.h"
#include "geometry/validation.h"
#include "paper/general_pcd_node.h"
#include "paper/geometry_tree.h"
#include "paper/hull_tree.h"

namespace fcl_prob {
namespace {

using namespace detail;

struct Query {
  const fcl::Transform3d& pose_a;
  const fcl::Transform3d& pose_b;
  const GaussianDisplacement& displacement;
  const GeneralPcdRequest& request;

  void validate() const {
    validatePose(pose_a, "pose of A");
    validatePose(pose_b, "pose of B");
    validateGeneralPcdRequest(request);
  }

  PairFrame frame(const BoundingTree& a, const BoundingTree& b) const {
    PairFrame frame(displacement, pose_a, a.size(), pose_b, b.size());
    frame.error += a.slack() + b.slack();
    return frame;
  }
};

template <typename BV>
GeneralPcdResult runOnModels(NodePairs& pairs, const ModelTree<BV>& a, const ModelTree<BV>& b,
                             const GeneralPcdRequest& request) {
  if (request.variant == GeneralPcdVariant::minimum) return generalPcdOver(pairs, request);
  PairSum sum(pairs, request);
  GeneralPcdTraversalNode<BV> node(a.model(), b.model(), sum);
  fcl::detail::collide(&node);
  return sum.result();
}

template <typename BV>
struct PairsOf {
  using Type = RoundedNodePairs<BV>;
};
template <>
struct PairsOf<fcl::kIOSd> {
  using Type = KiosNodePairs;
};
template <std::size_t N>
struct PairsOf<fcl::KDOP<double, N>> {
  using Type = SlabNodePairs<fcl::KDOP<double, N>>;
};
template <>
struct PairsOf<Kdop26> {
  using Type = SlabNodePairs<Kdop26>;
};

template <typename BV>
constexpr bool kHasSlabs = std::is_same_v<typename PairsOf<BV>::Type, SlabNodePairs<BV>>;

template <typename BV>
GeneralPcdResult pairOfModels(const fcl::BVHModel<BV>& a, const fcl::BVHModel<BV>& b,
                              const Query& query) {
  const ModelTree<BV> tree_a(a);
  const ModelTree<BV> tree_b(b);
  const PairFrame frame = query.frame(tree_a, tree_b);
  if (kHasSlabs<BV> && !frame.same_rotation) {
    NodePairs pairs(tree_a, tree_b, frame);
    return runOnModels(pairs, tree_a, tree_b, query.request);
  }
  typename PairsOf<BV>::Type pairs(tree_a, tree_b, frame);
  return runOnModels(pairs, tree_a, tree_b, query.request);
}

GeneralPcdResult pairOfTrees(const BoundingTree& a, const BoundingTree& b, const Query& query) {
  const PairFrame frame = query.frame(a, b);
  NodePairs pairs(a, b, frame);
  return generalPcdOver(pairs, query.request);
}

template <typename BV>
GeneralPcdResult pairOfOwnModels(const fcl::BVHModel<BV>& a, const fcl::BVHModel<BV>& b,
                                 const Query& query) {
  validateMeshView(viewOf(a), "object A");
  validateMeshView(viewOf(b), "object B");
  query.validate();
  return pairOfModels(a, b, query);
}

}  // namespace

GeneralPcdResult generalPcd(const fcl::CollisionGeometryd& a, const fcl::Transform3d& pose_a,
                            const fcl::CollisionGeometryd& b, const fcl::Transform3d& pose_b,
                            const GaussianDisplacement& displacement,
                            const GeneralPcdRequest& request) {
  const Query query{pose_a, pose_b, displacement, request};
  requireTree(a, "object A", "GeneralPCD");
  requireTree(b, "object B", "GeneralPCD");
  query.validate();
  const bool meshes = kindOf(a) == GeometryKind::mesh && kindOf(b) == GeometryKind::mesh;
  if (!meshes) return pairOfTrees(*makeTree(a), *makeTree(b), query);
  if (a.getNodeType() != b.getNodeType()) {
    throw UnsupportedGeometry("GeneralPCD needs one bounding volume for both meshes, not " +
                              nodeTypeName(a.getNodeType()) + " and " +
                              nodeTypeName(b.getNodeType()));
  }
  return visitMesh(a, [&](const auto& model_a) {
    using Model = std::decay_t<decltype(model_a)>;
    return pairOfModels(model_a, static_cast<const Model&>(b), query);
  });
}

GeneralPcdResult generalPcd(const fcl::BVHModel<SphereBv>& a, const fcl::Transform3d& pose_a,
                            const fcl::BVHModel<SphereBv>& b, const fcl::Transform3d& pose_b,
                            const GaussianDisplacement& displacement,
                            const GeneralPcdRequest& request) {
  return pairOfOwnModels(a, b, {pose_a, pose_b, displacement, request});
}

GeneralPcdResult generalPcd(const fcl::BVHModel<Kdop26>& a, const fcl::Transform3d& pose_a,
                            const fcl::BVHModel<Kdop26>& b, const fcl::Transform3d& pose_b,
                            const GaussianDisplacement& displacement,
                            const GeneralPcdRequest& request) {
  return pairOfOwnModels(a, b, {pose_a, pose_b, displacement, request});
}

GeneralPcdResult generalPcd(const ConvexHullTree& a, const fcl::Transform3d& pose_a,
                            const ConvexHullTree& b, const fcl::Transform3d& pose_b,
                            const GaussianDisplacement& displacement,
                            const GeneralPcdRequest& request) {
  const Query query{pose_a, pose_b, displacement, request};
  query.validate();
  return pairOfTrees(a.tree(), b.tree(), query);
}

}  // namespace fcl_prob
