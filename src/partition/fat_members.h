// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The C-obstacles of several convex bodies that move as one, and the triangles of another mesh.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "partition/fat_obstacles.h"

namespace fcl_prob::detail {

/// One V_t = P ⊕ T_t.
struct FatObstacle {
  int member = -1;    ///< whose P it is; -1: none at all
  int triangle = -1;  ///< t
};

/// P ⊕ a box of the tree of the mesh.
struct FatNode {
  int member;
  int node;
};

/// FatObstacles of every member, in the same frame and of the same mesh. A part that is convex is
/// one member; one that is nearly convex two, its core and the hull around it.
class FatMembers {
 public:
  /// \param body    of which every part is convex, or nearly; A if `fan_is_a`
  /// \param matrix  that of the whitening
  FatMembers(const WhitenedPair& pair, const PartitionObject& body, bool fan_is_a,
             const Eigen::Matrix3d& matrix);

  /// Of one that has not been asked for anything.
  static std::size_t leastMemory(const PartitionObject& body, const PartitionObject& mesh);

  FatObstacles& of(int member) { return members_[member]; }
  const FatObstacles& of(int member) const { return members_[member]; }
  int count() const { return static_cast<int>(members_.size()); }

  /// The part that it is, or is in, or is around.
  std::size_t partOf(int member) const { return parts_[member].index; }

  /// Whether it is a hull: what does not touch it does not touch its part, and no more is said.
  /// What touches any other member touches the body.
  bool encloses(int member) const { return parts_[member].encloses; }
  const WhitenedTree& mesh() const { return members_.front().mesh(); }

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

  std::deque<FatObstacles> members_;
  std::vector<OfPart> parts_;  ///< by member
  std::vector<int> first_faces_;
};

}  // namespace fcl_prob::detail
