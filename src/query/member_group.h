// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The members of a group, prepared, and where they are in one query.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "fcl_prob/convex_body.h"
#include "fcl_prob/exceptions.h"
#include "geometry/validation.h"
#include "query/bounded_part.h"
#include "query/partition.h"
#include "query/prepared_geometry.h"

namespace fcl_prob::detail {

/// The members of one side, and the tree of those that are bounded. Members that fcl::collide
/// leaves out wherever they are belong to neither the bounded nor the unbounded ones.
class MemberGroup {
 public:
  /// \param about  none, or where the members are in all queries, more or less: the same ones in a
  ///               row are one body in several places (see joinPieceTrees())
  MemberGroup(PreparedGeometries members, const std::string& name,
              std::vector<fcl::Transform3d> about = {})
      : name_(name), members_(std::move(members)), about_(std::move(about)) {
    if (members_.empty()) throw InvalidGeometry(name + " has no members");
    for (std::size_t i = 0; i < members_.size(); ++i) {
      if (isLeftOut(members_[i]->geometry())) continue;
      (members_[i]->hasPieces() ? bounded_ : unbounded_).push_back(i);
    }
  }

  /// How messages call it.
  const std::string& name() const { return name_; }
  const PreparedGeometries& members() const { return members_; }

  /// Of the bounded members, made when it is first needed.
  const PieceTree& tree() const {
    std::call_once(tree_once_, [this] {
      std::vector<const PieceTree*> trees;
      std::vector<fcl::Transform3d> about;
      for (const std::size_t i : bounded_) {
        trees.push_back(&members_[i]->pieces());
        if (!about_.empty()) about.push_back(about_[i]);
      }
      // That of a single one is not copied.
      tree_ = trees.size() == 1 ? std::shared_ptr<const PieceTree>(members_[bounded_[0]], trees[0])
                                : joinPieceTrees(trees, about);
    });
    return *tree_;
  }

  const std::vector<std::size_t>& bounded() const { return bounded_; }
  const std::vector<std::size_t>& unbounded() const { return unbounded_; }
  bool anyUnbounded() const { return !unbounded_.empty(); }
  bool isEmpty() const { return bounded_.empty() && unbounded_.empty(); }
  std::size_t leftOut() const { return members_.size() - bounded_.size() - unbounded_.size(); }

  bool haveRootBodies() const {
    return std::all_of(members_.begin(), members_.end(),
                       [](const auto& member) { return member->hasRootBody(); });
  }

  /// Of its members that are not left out.
  bool areConvex() const {
    return !anyUnbounded() && std::all_of(bounded_.begin(), bounded_.end(),
                                          [&](std::size_t i) { return members_[i]->isConvex(); });
  }

  /// The one place of all bounded members, if they have one.
  const fcl::Transform3d* onePlace(const std::vector<fcl::Transform3d>& poses) const {
    const auto isThere = [&](std::size_t i) {
      return poses[i].matrix() == poses[bounded_.front()].matrix();
    };
    const bool one = !bounded_.empty() && std::all_of(bounded_.begin(), bounded_.end(), isThere);
    return one ? &poses[bounded_.front()] : nullptr;
  }

  /// Of the bounded members, which are convex.
  std::vector<ConvexBody> bodies() const {
    std::vector<ConvexBody> bodies;
    for (const std::size_t i : bounded_) bodies.push_back(members_[i]->rootBody());
    return bodies;
  }

  void validate(const std::vector<fcl::Transform3d>& poses) const {
    if (poses.size() != members_.size()) {
      throw InvalidRequest(name_ + " has " + std::to_string(members_.size()) + " members but " +
                           std::to_string(poses.size()) + " poses");
    }
    for (std::size_t i = 0; i < poses.size(); ++i) {
      validatePose(poses[i], "member " + std::to_string(i) + " of " + name_);
    }
  }

  /// The bounded members, placed. \throws OpenMesh
  PartitionObject placed(const std::vector<fcl::Transform3d>& poses, ContactMeaning contact) const {
    PartitionObject object{&tree(), {}};
    for (const std::size_t i : bounded_) {
      object.parts.push_back({poses[i], members_[i]->solid(contact)});
    }
    return object;
  }

  bool hasOcTree() const {
    return std::any_of(members_.begin(), members_.end(), [](const auto& member) {
      return member->geometry().getNodeType() == fcl::GEOM_OCTREE;
    });
  }

 private:
  static bool isLeftOut(const fcl::CollisionGeometryd& geometry) {
    return geometry.getNodeType() != fcl::GEOM_OCTREE && !geometry.isOccupied();
  }

  std::string name_;
  PreparedGeometries members_;
  std::vector<fcl::Transform3d> about_;
  std::vector<std::size_t> bounded_;
  std::vector<std::size_t> unbounded_;
  mutable std::once_flag tree_once_;
  mutable std::shared_ptr<const PieceTree> tree_;
};

/// A group with what the displacement can reach of its unbounded members.
class PlacedGroup {
 public:
  PlacedGroup(const MemberGroup& group, const std::vector<fcl::Transform3d>& poses,
              ContactMeaning contact)
      : group_(group), poses_(poses), object_(group.placed(poses, contact)) {}

  /// Its parts are the bounded members in their order, and behind them the unbounded ones.
  const PartitionObject& object() const { return object_; }

  /// Adds the unbounded members, as far as `other` can get.
  /// \param besides  metres: how much farther its points may be
  void boundBy(const PartitionObject& other, const GaussianDisplacement& displacement,
               double besides = 0.0) {
    if (!group_.anyUnbounded()) return;
    ReachedBall ball = reachedBall(other, displacement, kReach);
    ball.radius += besides;
    std::vector<const PieceTree*> trees{&group_.tree()};
    for (const std::size_t i : group_.unbounded()) {
      const auto part = boundedPart(group_.members()[i]->geometry(), poses_[i], ball);
      stand_ins_.push_back(buildPieceTree(*part.geometry));
      trees.push_back(stand_ins_.back().get());
      object_.parts.push_back({part.pose, nullptr});
    }
    joined_ = joinPieceTrees(trees);
    object_.tree = joined_.get();
  }

 private:
  const MemberGroup& group_;
  const std::vector<fcl::Transform3d>& poses_;
  PartitionObject object_;
  std::vector<std::shared_ptr<const PieceTree>> stand_ins_;
  std::shared_ptr<const PieceTree> joined_;
};

}  // namespace fcl_prob::detail
