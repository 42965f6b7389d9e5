// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/volume_trees.h"

#include <map>

#include "fcl_prob/convex_hull_tree.h"
#include "paper/hull_tree.h"

namespace fcl_prob::cli {
namespace {

/// \param volume_of, left_child_of  of a node's index; the left child is negative at a leaf, else
/// the right one follows it
template <typename Volume, typename LeftChild>
std::vector<double> volumesByLevel(int levels, Volume&& volume_of, LeftChild&& left_child_of) {
  std::vector<double> volumes;
  std::vector<int> nodes{0};
  for (int level = 0; level < levels; ++level) {
    double sum = 0.0;
    std::vector<int> next;
    for (const int node : nodes) {
      sum += volume_of(node);
      const int left = left_child_of(node);
      if (left < 0) {
        next.push_back(node);
      } else {
        next.insert(next.end(), {left, left + 1});
      }
    }
    volumes.push_back(sum);
    nodes.swap(next);
  }
  return volumes;
}

template <typename BV>
std::vector<double> volumesByLevel(const fcl::BVHModel<BV>& model, int levels) {
  return volumesByLevel(
      levels, [&model](int node) { return volumeOf(model.getBV(node).bv); },
      [&model](int node) {
        return model.getBV(node).isLeaf() ? -1 : model.getBV(node).leftChild();
      });
}

std::vector<double> volumesByLevel(const ConvexHullTree& tree, int levels) {
  return volumesByLevel(
      levels, [&tree](int node) { return tree.volume(node); },
      [&tree](int node) { return tree.tree().leftChild(node); });
}

template <typename Tree>
class VolumeTreesOf final : public VolumeTrees {
 public:
  VolumeTreesOf(Tree a, Tree b) : a_(std::move(a)), b_(std::move(b)) {}

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
std::unique_ptr<VolumeTrees> modelPair(const TriangleMesh& a, const TriangleMesh& b) {
  using Tree = std::shared_ptr<fcl::BVHModel<BV>>;
  return std::make_unique<VolumeTreesOf<Tree>>(buildModel<BV>(a), buildModel<BV>(b));
}

std::unique_ptr<VolumeTrees> hullPair(const TriangleMesh& a, const TriangleMesh& b) {
  using Tree = std::shared_ptr<ConvexHullTree>;
  const auto tree = [](const TriangleMesh& mesh) {
    return std::make_shared<ConvexHullTree>(*buildModel<fcl::OBBd>(mesh));
  };
  return std::make_unique<VolumeTreesOf<Tree>>(tree(a), tree(b));
}

}  // namespace

double hullVolume(const TriangleMesh& mesh) {
  return detail::volumeOf(detail::makeConvexMesh(mesh.vertices));
}

std::unique_ptr<VolumeTrees> makeVolumeTrees(const std::string& bounding_volume,
                                             const TriangleMesh& a, const TriangleMesh& b) {
  using Maker = std::unique_ptr<VolumeTrees> (*)(const TriangleMesh&, const TriangleMesh&);
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
