// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The C-obstacles of several convex bodies that move as one, and the pieces of another mesh.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
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

  /// What all piecesWithin() take in addition.
  static std::size_t memoryOfPieces(const PartitionObject& body, const PartitionObject& mesh);

  /// From here on there are no pieces.
  void keepHullsClosed() { hulls_stay_closed_ = true; }

  FatObstacles& of(int member) { return *members_[member]; }
  const FatObstacles& of(int member) const { return *members_[member]; }

  FatObstacles::Planes planesOf(FatObstacle obstacle) const {
    return of(obstacle.member).planesOf(obstacle.piece);
  }

  /// Of a member below count().
  const NodeReach& reachOf(int member) const { return reaches_[member]; }

  /// Without those within hulls, which come behind them.
  int count() const { return count_; }

  /// The part that it is, or is in, or is around.
  std::size_t partOf(int member) const { return parts_[member].index; }

  /// Whether it is a hull: what does not touch it does not touch its part, and no more is said.
  /// What touches any other member touches the body.
  bool encloses(int member) const { return parts_[member].encloses; }

  /// The members beside its core that a hull is around: what touches none of all these does not
  /// touch the part. They are made when they are first asked for, by any of several threads; empty
  /// if there are none.
  const std::vector<int>& piecesWithin(int hull);

  const WhitenedPolygons& pieces() const { return pieces_; }

  /// Where the faces of a member begin among those of all.
  int firstFace(int member) const { return first_faces_[member]; }
  /// Of the members below count().
  int faceCount() const { return first_faces_[count_]; }
  int memberCount() const { return static_cast<int>(members_.size()); }
  int faceCountOfAll() const { return first_faces_.back(); }

  bool usable() const;
  bool failed() const;
  std::size_t memory() const;
  std::size_t built() const;

 private:
  struct OfPart {
    std::size_t index;
    bool encloses;
  };

  /// The members within a hull.
  struct Within {
    int first;  ///< of them
    std::once_flag made;
    std::vector<int> members;
  };

  void add(std::size_t part, const ConvexFan& fan, bool encloses);
  void reserveWithin(int hull);
  void makeWithin(int hull, Within& within);
  std::unique_ptr<FatObstacles> obstaclesOf(std::size_t part, const ConvexFan& fan) const;
  template <typename Function>
  void visit(const Function& function) const;

  const WhitenedPair& pair_;
  const PartitionObject& body_;
  const bool fan_is_a_;
  const Eigen::Matrix3d matrix_;
  const WhitenedPolygons pieces_;
  bool hulls_stay_closed_ = false;
  std::vector<std::unique_ptr<FatObstacles>> members_;  ///< null: not made yet
  std::vector<OfPart> parts_;                           ///< by member
  std::vector<NodeReach> reaches_;                      ///< by member below count()
  int count_ = 0;
  std::vector<int> first_faces_;
  std::deque<Within> within_;
  std::vector<Within*> within_of_;  ///< by member below count(), null for those that are no hulls
};

}  // namespace fcl_prob::detail
