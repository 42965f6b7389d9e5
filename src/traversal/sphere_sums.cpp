// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The prior methods for two spheres, for all pairs that two trees of spheres are refined to.
#include <algorithm>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/prior_methods.h"
#include "gaussian/number_text.h"
#include "geometry/mesh_visitor.h"
#include "geometry/validation.h"
#include "narrowphase/sphere_methods.h"
#include "traversal/pair_sum.h"

namespace fcl_prob {
namespace {

using namespace detail;

using SphereModel = fcl::BVHModel<SphereBv>;
using Method = double (*)(const DisplacementBall&, const PairFrame&);

double clippedPark(const DisplacementBall& ball, const PairFrame& frame) {
  return std::min(1.0, largestDensityTimesVolume(ball, frame));
}

class SphereNodePairs final : public NodePairs {
 public:
  SphereNodePairs(const ModelTree<SphereBv>& a, const ModelTree<SphereBv>& b,
                  const PairFrame& frame, Method method)
      : NodePairs(a, b, frame), model_a_(a.model()), model_b_(b.model()), method_(method) {}

  double bound(int node_a, int node_b) override {
    const SphereBv& a = model_a_.getBV(node_a).bv;
    const SphereBv& b = model_b_.getBV(node_b).bv;
    return method_(obstacleOf(frame(), a.center(), a.radius(), b.center(), b.radius()), frame());
  }

 private:
  const SphereModel& model_a_;
  const SphereModel& model_b_;
  Method method_;
};

struct SphereQuery {
  const fcl::Transform3d& pose_a;
  const fcl::Transform3d& pose_b;
  const GaussianDisplacement& displacement;
  GeneralPcdRequest request;
};

GeneralPcdResult sumOver(const SphereModel& a, const SphereModel& b, const SphereQuery& query,
                         Method method) {
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
  SphereNodePairs pairs(tree_a, tree_b, frame, method);
  return generalPcdOver(pairs, query.request);
}

GeneralPcdRequest byVolumes(GeneralPcdRequest request) {
  request.leaf_bound = LeafBound::volumes;
  return request;
}

}  // namespace

GeneralPcdResult parkSum(const SphereModel& a, const fcl::Transform3d& pose_a, const SphereModel& b,
                         const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                         const GeneralPcdRequest& request) {
  return sumOver(a, b, {pose_a, pose_b, displacement, byVolumes(request)}, clippedPark);
}

double duToitBurdickSum(const SphereModel& a, const fcl::Transform3d& pose_a, const SphereModel& b,
                        const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                        const GeneralPcdRequest& request) {
  return sumOver(a, b, {pose_a, pose_b, displacement, byVolumes(request)},
                 centralDensityTimesVolume)
      .raw_sum;
}

}  // namespace fcl_prob
