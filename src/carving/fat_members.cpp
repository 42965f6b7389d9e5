// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "carving/fat_members.h"

#include <algorithm>
#include <utility>

namespace fcl_prob::detail {

FatMembers::FatMembers(const WhitenedPair& pair, const PartitionObject& body, bool fan_is_a,
                       const Eigen::Matrix3d& matrix)
    : pair_(pair), body_(body), fan_is_a_(fan_is_a), matrix_(matrix), first_faces_{0} {
  for (std::size_t i = 0; i < body.parts.size(); ++i) {
    const PieceTree::Part& part = body.tree->parts[i];
    if (part.fan) {
      add(i, *part.fan, false);
    } else {
      add(i, part.nearly->core, false);
      add(i, part.nearly->hull, true);
    }
  }
}

void FatMembers::add(std::size_t part, const ConvexFan& fan, bool encloses) {
  members_.emplace_back(pair_, body_.tree->parts[part], fan, fan_is_a_,
                        matrix_ * body_.parts[part].pose.linear());
  parts_.push_back({part, encloses, std::nullopt});
  first_faces_.push_back(first_faces_.back() + members_.back().faceCount());
}

std::size_t FatMembers::memoryOfPieces(const PartitionObject& body, const PartitionObject& mesh) {
  std::size_t pieces = 0;
  for (const PieceTree::Part& part : body.tree->parts) {
    if (part.nearly) pieces += part.nearly->pieces.size();
  }
  return pieces * FatObstacles::leastMemory(mesh.tree->triangles.size());
}

// Where one of them is not known well enough there is none.
const std::vector<int>& FatMembers::piecesWithin(int hull) {
  if (!parts_[hull].pieces) {
    const std::size_t part = parts_[hull].index;
    const int first = count();
    std::vector<int> pieces;
    if (!hulls_stay_closed_) {
      for (const ConvexFan& fan : body_.tree->parts[part].nearly->pieces) {
        add(part, fan, false);
        pieces.push_back(count() - 1);
      }
    }
    const bool all_usable = std::all_of(members_.begin() + first, members_.end(),
                                        [](const FatObstacles& member) { return member.usable(); });
    if (!all_usable) pieces.clear();
    parts_[hull].pieces = std::move(pieces);
  }
  return *parts_[hull].pieces;
}

std::size_t FatMembers::leastMemory(const PartitionObject& body, const PartitionObject& mesh) {
  std::size_t members = 0;
  for (const PieceTree::Part& part : body.tree->parts) members += part.fan ? 1 : 2;
  return members * FatObstacles::leastMemory(mesh.tree->triangles.size());
}

bool FatMembers::usable() const {
  return std::all_of(members_.begin(), members_.end(),
                     [](const FatObstacles& member) { return member.usable(); });
}

bool FatMembers::failed() const {
  return std::any_of(members_.begin(), members_.end(),
                     [](const FatObstacles& member) { return member.failed(); });
}

std::size_t FatMembers::memory() const {
  std::size_t bytes = 0;
  for (const FatObstacles& member : members_) bytes += member.memory();
  return bytes;
}

std::size_t FatMembers::built() const {
  std::size_t count = 0;
  for (const FatObstacles& member : members_) count += member.built();
  return count;
}

}  // namespace fcl_prob::detail
