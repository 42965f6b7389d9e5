// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/part_tree.h"

#include <fcl/math/bv/utility.h>

#include <algorithm>

#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "geometry/validation.h"
#include "paper/bv_volumes.h"
#include "paper/pair_sum.h"
#include "paper/part_bounding_tree.h"

namespace fcl_prob {
namespace detail {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// A bounding volume as a body, with its volume.
struct Bounded {
  ConvexBody body;
  double volume;
};

/// FCL's own fit to points.
template <typename BV>
BV fitted(const Points& points) {
  BV volume;
  Points copy = points;
  fcl::fit(copy.data(), static_cast<int>(copy.size()), volume);
  return volume;
}
template <>
Kdop26 fitted<Kdop26>(const Points& points) {
  Kdop26 volume;
  for (const Eigen::Vector3d& point : points) volume += point;
  return volume;
}
template <>
SphereBv fitted<SphereBv>(const Points& points) {
  return SphereBv::around(points);
}

template <typename BV>
Bounded boundedBy(const Points& points) {
  const BV volume = fitted<BV>(points);
  return {ConvexBody(volume), volumeOf(volume)};
}

Bounded bounded(PartVolume volume, const Points& points) {
  switch (volume) {
    case PartVolume::sphere:
      return boundedBy<SphereBv>(points);
    case PartVolume::aabb:
      return boundedBy<fcl::AABBd>(points);
    case PartVolume::obb:
      return boundedBy<fcl::OBBd>(points);
    case PartVolume::rss:
      return boundedBy<fcl::RSSd>(points);
    case PartVolume::obbrss:
      return boundedBy<fcl::OBBRSSd>(points);
    case PartVolume::kios:
      return boundedBy<fcl::kIOSd>(points);
    case PartVolume::kdop16:
      return boundedBy<fcl::KDOPd<16>>(points);
    case PartVolume::kdop18:
      return boundedBy<fcl::KDOPd<18>>(points);
    case PartVolume::kdop24:
      return boundedBy<fcl::KDOPd<24>>(points);
    case PartVolume::kdop26:
      return boundedBy<Kdop26>(points);
    case PartVolume::convex: {
      const ConvexBody hull(points);
      return {hull, volumeOf(hull.set().outerMesh())};
    }
  }
  throw InvalidRequest("not one of PartVolume");
}

}  // namespace

PartBoundingTree::PartBoundingTree(const ConvexParts& parts, PartVolume volume)
    : volume_(volume), nodes_(2 * parts.size() - 1) {
  std::vector<Branch> branches;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    branches.push_back({i, -1, -1, parts.polytope(i).vertices});
  }
  for (const auto& [left, right] : parts.unions()) {
    Branch both{0, static_cast<int>(left), static_cast<int>(right), branches[left].points};
    both.points.insert(both.points.end(), branches[right].points.begin(),
                       branches[right].points.end());
    branches.push_back(std::move(both));
  }
  // From the root down, so that the children of a node are neighbours.
  std::vector<int> branch_of{static_cast<int>(branches.size()) - 1};
  for (std::size_t node = 0; node < branch_of.size(); ++node) {
    const Branch& branch = branches[branch_of[node]];
    if (branch.left >= 0) {
      nodes_[node].left = static_cast<int>(branch_of.size());
      branch_of.insert(branch_of.end(), {branch.left, branch.right});
    }
    fill(nodes_[node], branch, parts);
  }
}

void PartBoundingTree::fill(Node& node, const Branch& branch, const ConvexParts& parts) {
  Bounded around = bounded(volume_, branch.points);
  node.body = std::move(around.body);
  node.volume = around.volume;
  if (branch.left < 0) node.piece = parts.body(branch.part);
  for (const auto& body : {node.body, node.piece}) {
    if (!body) continue;
    size_ = std::max(size_, body->set().size());
    slack_ = std::max(slack_, body->set().slack());
  }
}

}  // namespace detail

PartTree::PartTree(const ConvexParts& parts, PartVolume volume)
    : tree_(std::make_shared<const detail::PartBoundingTree>(parts, volume)) {}

PartVolume PartTree::boundingVolume() const { return tree_->boundingVolume(); }

std::size_t PartTree::nodeCount() const { return tree_->nodeCount(); }

double PartTree::volume(std::size_t node) const { return tree_->volume(static_cast<int>(node)); }

GeneralPcdResult generalPcd(const PartTree& a, const fcl::Transform3d& pose_a, const PartTree& b,
                            const fcl::Transform3d& pose_b,
                            const GaussianDisplacement& displacement,
                            const GeneralPcdRequest& request) {
  if (a.boundingVolume() != b.boundingVolume()) {
    throw InvalidRequest("GeneralPCD needs one bounding volume for both trees of parts");
  }
  detail::validatePose(pose_a, "pose of A");
  detail::validatePose(pose_b, "pose of B");
  detail::validateGeneralPcdRequest(request);
  detail::PairFrame frame(displacement, pose_a, a.tree().size(), pose_b, b.tree().size());
  frame.error += a.tree().slack() + b.tree().slack();
  detail::NodePairs pairs(a.tree(), b.tree(), frame);
  return detail::generalPcdOver(pairs, request);
}

}  // namespace fcl_prob
