// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/tree_pair.h"

#include <algorithm>
#include <map>

#include "cli/volumes.h"

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

  std::vector<double> volumes(int levels) const override { return volumesByLevel(*a_, levels); }

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

std::unique_ptr<TreePair> makeTreePair(const std::string& bounding_volume, const TriangleMesh& a,
                                       const TriangleMesh& b) {
  using Maker = std::unique_ptr<TreePair> (*)(const TriangleMesh&, const TriangleMesh&);
  static const std::map<std::string, Maker> makers{{"sphere", modelPair<SphereBv>},
                                                   {"aabb", modelPair<fcl::AABBd>},
                                                   {"obb", modelPair<fcl::OBBd>},
                                                   {"rss", modelPair<fcl::RSSd>},
                                                   {"obbrss", modelPair<fcl::OBBRSSd>},
                                                   {"kios", modelPair<fcl::kIOSd>},
                                                   {"kdop16", modelPair<fcl::KDOPd<16>>},
                                                   {"kdop18", modelPair<fcl::KDOPd<18>>},
                                                   {"kdop24", modelPair<fcl::KDOPd<24>>},
                                                   {"kdop26", modelPair<Kdop26>},
                                                   {"convex", hullPair}};
  const auto maker = makers.find(bounding_volume);
  if (maker == makers.end()) {
    throw InvalidRequest("unknown bounding volume '" + bounding_volume + "'");
  }
  return maker->second(a, b);
}

}  // namespace fcl_prob::cli
