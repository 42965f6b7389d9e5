// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The C-obstacles of several convex bodies that move as one, and the pieces of another mesh.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "cells/fat_obstacles.h"
#include "cells/node_reach.h"
#include "mass/cell_mass.h"
#include "scene/whitened_polygons.h"

namespace fcl_prob::detail {

/// One V_t = P ⊕ T_t.
struct FatObstacle {
  int member = -1;  ///< whose P it is; -1: none at all
  int piece = -1;   ///< t
};

/// P ⊕ a box of the tree of the mesh's pieces.
struct FatNode {
  int member;
  int node;
};

/// FatObstacles of every member, in the same frame and of the same mesh. A part that is convex is
/// one member; one that is nearly convex two, its core and the hull around it.
class FatMembers {
 public:
  /// \param body    of which every part is convex, or nearly; A if `fan_is_a`
  /// \param mesh    the other one
  /// \param matrix  that of the whitening
  ///
  /// Keeps references to the pair and the body.
  FatMembers(const WhitenedPair& pair, const PartitionObject& body, const PartitionObject& mesh,
             bool fan_is_a, const Eigen::Matrix3d& matrix,
             double most_loss = WhitenedPolygons::kMostLoss);

  /// Of one that has not been asked for anything.
  static std::size_t leastMemory(const PartitionObject& body, const PartitionObject& mesh);

  FatObstacles& of(int member) { return members_[member]; }
  const FatObstacles& of(int member) const { return members_[member]; }

  FatObstacles::Planes planesOf(FatObstacle obstacle) const {
    return of(obstacle.member).planesOf(obstacle.piece);
  }

  const NodeReach& reachOf(int member) const { return reaches_[member]; }

  int count() const { return static_cast<int>(members_.size()); }

  /// The part that it is, or is in, or is around.
  std::size_t partOf(int member) const { return parts_[member].index; }

  /// Whether it is a hull: what does not touch it does not touch its part, and no more is said.
  /// What touches any other member touches the body.
  bool encloses(int member) const { return parts_[member].encloses; }

  const WhitenedPolygons& pieces() const { return pieces_; }

  /// Where the faces of a member begin among those of all.
  int firstFace(int member) const { return first_faces_[member]; }
  int faceCount() const { return first_faces_.back(); }

  bool usable() const;
  bool failed() const;
  std::size_t memory() const;
  std::size_t built() const;

 private:
  struct OfPart {
    std::size_t index;
    bool encloses;
  };

  const WhitenedPolygons pieces_;
  std::deque<FatObstacles> members_;  ///< in places that do not move
  std::vector<OfPart> parts_;         ///< by member
  std::vector<NodeReach> reaches_;    ///< by member
  std::vector<int> first_faces_;
};

}  // namespace fcl_prob::detail
