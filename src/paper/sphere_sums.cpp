// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The prior methods for two spheres, for all pairs that two trees of spheres are refined to.
#include <algorithm>

#include "bounds/sphere_methods.h"
#include "fcl_prob/prior_methods.h"
#include "geometry/mesh_visitor.h"
#include "geometry/validation.h"
#include "paper/pair_sum.h"

namespace fcl_prob {
namespace {

using namespace detail;

using SphereModel = fcl::BVHModel<SphereBv>;

/// Pairs of spheres with Park's bound.
class SphereNodePairs final : public NodePairs {
 public:
  SphereNodePairs(const ModelTree<SphereBv>& a, const ModelTree<SphereBv>& b,
                  const PairFrame& frame)
      : NodePairs(a, b, frame), model_a_(a.model()), model_b_(b.model()) {}

  double bound(int node_a, int node_b) override {
    return std::min(1.0, largestDensityTimesVolume(obstacle(node_a, node_b), frame()));
  }

  double approximation(int node_a, int node_b) const {
    return centralDensityTimesVolume(obstacle(node_a, node_b), frame());
  }

 private:
  DisplacementBall obstacle(int node_a, int node_b) const {
    const SphereBv& a = model_a_.getBV(node_a).bv;
    const SphereBv& b = model_b_.getBV(node_b).bv;
    return obstacleOf(frame(), a.center(), a.radius(), b.center(), b.radius());
  }

  const SphereModel& model_a_;
  const SphereModel& model_b_;
};

class ApproximateSum {
 public:
  ApproximateSum(SphereNodePairs& pairs, const GeneralPcdRequest& request)
      : pairs_(pairs), request_(request) {}

  double over(int node_a, int node_b) {
    if (!refines(node_a, node_b)) return pairs_.approximation(node_a, node_b);
    double sum = 0.0;
    for (const NodePair& child : pairs_.children(node_a, node_b)) sum += over(child.a, child.b);
    return sum;
  }

 private:
  bool refines(int node_a, int node_b) {
    if (pairs_.areLeaves(node_a, node_b) || ++pairs_bounded_ >= request_.max_pairs) return false;
    return pairs_.bound(node_a, node_b) >= 1.0 - request_.confidence;
  }

  SphereNodePairs& pairs_;
  const GeneralPcdRequest& request_;
  std::size_t pairs_bounded_ = 0;
};

struct SphereQuery {
  const fcl::Transform3d& pose_a;
  const fcl::Transform3d& pose_b;
  const GaussianDisplacement& displacement;
  const GeneralPcdRequest& request;
};

/// Validates, and calls `function` with the pairs.
template <typename Function>
auto withPairs(const SphereModel& a, const SphereModel& b, const SphereQuery& query,
               Function&& function) {
  validateMeshView(viewOf(a), "object A");
  validateMeshView(viewOf(b), "object B");
  validatePose(query.pose_a, "pose of A");
  validatePose(query.pose_b, "pose of B");
  validateGeneralPcdRequest(query.request);
  requireDensity(query.displacement);
  const ModelTree<SphereBv> tree_a(a);
  const ModelTree<SphereBv> tree_b(b);
  const PairFrame frame(query.displacement, query.pose_a, tree_a.size(), query.pose_b,
                        tree_b.size());
  SphereNodePairs pairs(tree_a, tree_b, frame);
  return function(pairs);
}

}  // namespace

GeneralPcdResult parkSum(const SphereModel& a, const fcl::Transform3d& pose_a, const SphereModel& b,
                         const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                         const GeneralPcdRequest& request) {
  GeneralPcdRequest by_volumes = request;
  by_volumes.leaf_bound = LeafBound::volumes;
  return withPairs(a, b, {pose_a, pose_b, displacement, by_volumes},
                   [&](SphereNodePairs& pairs) { return generalPcdOver(pairs, by_volumes); });
}

double duToitBurdickSum(const SphereModel& a, const fcl::Transform3d& pose_a, const SphereModel& b,
                        const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                        const GeneralPcdRequest& request) {
  return withPairs(a, b, {pose_a, pose_b, displacement, request}, [&](SphereNodePairs& pairs) {
    return ApproximateSum(pairs, request).over(0, 0);
  });
}

}  // namespace fcl_prob
