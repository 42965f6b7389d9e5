// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/tree_pair.h"

#include <algorithm>

#include "base/decision.h"
#include "fcl_prob/convex_hull_tree.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob::cli {
namespace {

template <typename Tree>
TreePair pairOf(std::shared_ptr<Tree> a, std::shared_ptr<Tree> b) {
  return [a = std::move(a), b = std::move(b)](const auto& pose_a, const auto& pose_b,
                                              const auto& displacement, const auto& request) {
    return generalPcd(*a, pose_a, *b, pose_b, displacement, request);
  };
}

std::shared_ptr<ConvexHullTree> hullTree(const TriangleMesh& mesh) {
  return std::make_shared<ConvexHullTree>(*buildModel<fcl::OBBd>(mesh));
}

}  // namespace

const std::vector<std::string>& ownVolumeNames() {
  static const std::vector<std::string> names{"sphere", "kdop26", "convex"};
  return names;
}

bool isOwnVolume(const std::string& bounding_volume) {
  const auto& names = ownVolumeNames();
  return std::find(names.begin(), names.end(), bounding_volume) != names.end();
}

TreePair makeTreePair(const std::string& bounding_volume, const TriangleMesh& a,
                      const TriangleMesh& b) {
  if (bounding_volume == "sphere") return pairOf(buildModel<SphereBv>(a), buildModel<SphereBv>(b));
  if (bounding_volume == "kdop26") return pairOf(buildModel<Kdop26>(a), buildModel<Kdop26>(b));
  return pairOf(hullTree(a), hullTree(b));
}

GeneralPcdRequest pcdRequestOf(const ProbabilityRequest& request, const std::string& refusal) {
  const bool minimum = request.method == ProbabilityMethod::general_pcd_min;
  if (!minimum && request.method != ProbabilityMethod::general_pcd) throw InvalidRequest(refusal);
  GeneralPcdRequest pcd_request;
  pcd_request.confidence = request.confidence;
  pcd_request.max_pairs = request.max_cells;
  pcd_request.variant = minimum ? GeneralPcdVariant::minimum : GeneralPcdVariant::sum;
  return pcd_request;
}

ProbabilityResult resultOf(const GeneralPcdResult& pcd, const ProbabilityRequest& request) {
  ProbabilityResult result;
  result.method = request.method;
  result.upper = pcd.upper;
  result.status = pcd.complete ? ProbabilityStatus::bound_only : ProbabilityStatus::cell_limit;
  result.decision = detail::decisionOf({0.0, pcd.upper}, request);
  result.statistics.raw_sum = pcd.raw_sum;
  result.statistics.pairs_tested = pcd.pairs_bounded;
  result.statistics.leaf_pairs = pcd.leaf_pairs;
  return result;
}

}  // namespace fcl_prob::cli
