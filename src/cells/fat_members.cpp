// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/fat_members.h"

#include <algorithm>

namespace fcl_prob::detail {

FatMembers::FatMembers(const WhitenedPair& pair, const PartitionObject& body,
                       const PartitionObject& mesh, bool fan_is_a, const Eigen::Matrix3d& matrix,
                       double most_loss)
    : pieces_(fan_is_a ? pair.b : pair.a, mesh, matrix, most_loss), first_faces_{0} {
  for (std::size_t i = 0; i < body.parts.size(); ++i) {
    const PieceTree::Part& part = body.tree->parts[i];
    const auto add = [&](const ConvexFan& fan, bool encloses) {
      members_.emplace_back(pair, part, fan, fan_is_a, matrix * body.parts[i].pose.linear(),
                            pieces_);
      parts_.push_back({i, encloses});
      reaches_.emplace_back(members_.back(), pieces_);
      first_faces_.push_back(first_faces_.back() + members_.back().faceCount());
    };
    if (part.fan) {
      add(*part.fan, false);
    } else {
      add(part.nearly->core, false);
      add(part.nearly->hull, true);
    }
  }
}

std::size_t FatMembers::leastMemory(const PartitionObject& body, const PartitionObject& mesh) {
  std::size_t members = 0;
  for (const PieceTree::Part& part : body.tree->parts) members += part.fan ? 1 : 2;
  const std::size_t triangles = mesh.tree->triangles.size();
  return members * (FatObstacles::leastMemory(WhitenedPolygons::mostPieces(triangles)) +
                    NodeReach::memoryOf(WhitenedPolygons::mostNodes(triangles)));
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
  std::size_t bytes = pieces_.memory();
  bytes += reaches_.size() * NodeReach::memoryOf(pieces_.nodes().size());
  for (const FatObstacles& member : members_) bytes += member.memory();
  return bytes;
}

std::size_t FatMembers::built() const {
  std::size_t count = 0;
  for (const FatObstacles& member : members_) count += member.built();
  return count;
}

}  // namespace fcl_prob::detail
