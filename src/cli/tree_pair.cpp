// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/tree_pair.h"

#include <algorithm>

namespace fcl_prob::cli {
namespace {

template <typename Tree>
class TreePairOf final : public TreePair {
 public:
  TreePairOf(Tree a, Tree b) : a_(std::move(a)), b_(std::move(b)) {}

  GeneralPcdResult bound(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                         const GaussianDisplacement& displacement,
                         const GeneralPcdRequest& request) const override {
    return generalPcd(*a_, pose_a, *b_, pose_b, displacement, request);
  }

 private:
  Tree a_;
  Tree b_;
};

template <typename BV>
std::unique_ptr<TreePair> modelPair(const TriangleMesh& a, const TriangleMesh& b) {
  using Tree = std::shared_ptr<fcl::BVHModel<BV>>;
  return std::make_unique<TreePairOf<Tree>>(buildModel<BV>(a), buildModel<BV>(b));
}

std::unique_ptr<TreePair> hullPair(const TriangleMesh& a, const TriangleMesh& b) {
  using Tree = std::shared_ptr<ConvexHullTree>;
  const auto tree = [](const TriangleMesh& mesh) {
    return std::make_shared<ConvexHullTree>(*buildModel<fcl::OBBd>(mesh));
  };
  return std::make_unique<TreePairOf<Tree>>(tree(a), tree(b));
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

std::unique_ptr<TreePair> makeOwnTreePair(const std::string& bounding_volume, const TriangleMesh& a,
                                          const TriangleMesh& b) {
  if (bounding_volume == "sphere") return modelPair<SphereBv>(a, b);
  if (bounding_volume == "kdop26") return modelPair<Kdop26>(a, b);
  if (bounding_volume == "convex") return hullPair(a, b);
  throw InvalidRequest("unknown bounding volume '" + bounding_volume + "'");
}

}  // namespace fcl_prob::cli
