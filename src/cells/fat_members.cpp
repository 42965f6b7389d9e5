// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/fat_members.h"

#include <algorithm>
#include <utility>

namespace fcl_prob::detail {

FatMembers::FatMembers(const WhitenedPair& pair, const PartitionObject& body,
                       const PartitionObject& mesh, bool fan_is_a, const Eigen::Matrix3d& matrix,
                       double most_loss)
    : pair_(pair),
      body_(body),
      fan_is_a_(fan_is_a),
      matrix_(matrix),
      pieces_(fan_is_a ? pair.b : pair.a, mesh, matrix, most_loss),
      first_faces_{0} {
  for (std::size_t i = 0; i < body.parts.size(); ++i) {
    const PieceTree::Part& part = body.tree->parts[i];
    if (part.fan) {
      add(i, *part.fan, false);
    } else {
      add(i, part.nearly->core, false);
      add(i, part.nearly->hull, true);
    }
  }
  count_ = static_cast<int>(members_.size());
  within_of_.resize(members_.size());
  for (int member = 0; member < count(); ++member) {
    if (encloses(member)) reserveWithin(member);
  }
}

void FatMembers::add(std::size_t part, const ConvexFan& fan, bool encloses) {
  members_.push_back(obstaclesOf(part, fan));
  parts_.push_back({part, encloses});
  reaches_.emplace_back(*members_.back(), pieces_);
  first_faces_.push_back(first_faces_.back() + members_.back()->faceCount());
}

// Places that do not move when they are filled, so that other members may be used meanwhile.
void FatMembers::reserveWithin(int hull) {
  const std::size_t part = partOf(hull);
  Within& within = within_.emplace_back();
  within.first = static_cast<int>(members_.size());
  within_of_[hull] = &within;
  for (const ConvexFan& piece : body_.tree->parts[part].nearly->pieces) {
    members_.emplace_back();
    parts_.push_back({part, false});
    first_faces_.push_back(first_faces_.back() + static_cast<int>(piece.normals.size()));
  }
}

std::unique_ptr<FatObstacles> FatMembers::obstaclesOf(std::size_t part,
                                                      const ConvexFan& fan) const {
  return std::make_unique<FatObstacles>(pair_, body_.tree->parts[part], fan, fan_is_a_,
                                        matrix_ * body_.parts[part].pose.linear(), pieces_);
}

template <typename Function>
void FatMembers::visit(const Function& function) const {
  for (const std::unique_ptr<FatObstacles>& member : members_) {
    if (member) function(*member);
  }
}

std::size_t FatMembers::memoryOfPieces(const PartitionObject& body, const PartitionObject& mesh) {
  std::size_t pieces = 0;
  for (const PieceTree::Part& part : body.tree->parts) {
    if (part.nearly) pieces += part.nearly->pieces.size();
  }
  return pieces *
         FatObstacles::leastMemory(WhitenedPolygons::mostPieces(mesh.tree->triangles.size()));
}

const std::vector<int>& FatMembers::piecesWithin(int hull) {
  Within& within = *within_of_[hull];
  std::call_once(within.made, [&] { makeWithin(hull, within); });
  return within.members;
}

// Where one of them is not known well enough there is none.
void FatMembers::makeWithin(int hull, Within& within) {
  if (hulls_stay_closed_) return;
  bool all_usable = true;
  for (const ConvexFan& fan : body_.tree->parts[partOf(hull)].nearly->pieces) {
    const int member = within.first + static_cast<int>(within.members.size());
    members_[member] = obstaclesOf(partOf(hull), fan);
    all_usable = all_usable && members_[member]->usable();
    within.members.push_back(member);
  }
  if (!all_usable) within.members.clear();
}

std::size_t FatMembers::leastMemory(const PartitionObject& body, const PartitionObject& mesh) {
  std::size_t members = 0;
  for (const PieceTree::Part& part : body.tree->parts) members += part.fan ? 1 : 2;
  const std::size_t triangles = mesh.tree->triangles.size();
  return members * (FatObstacles::leastMemory(WhitenedPolygons::mostPieces(triangles)) +
                    NodeReach::memoryOf(WhitenedPolygons::mostNodes(triangles)));
}

bool FatMembers::usable() const {
  bool all = true;
  visit([&](const FatObstacles& member) { all = all && member.usable(); });
  return all;
}

bool FatMembers::failed() const {
  bool any = false;
  visit([&](const FatObstacles& member) { any = any || member.failed(); });
  return any;
}

std::size_t FatMembers::memory() const {
  std::size_t bytes = 0;
  visit([&](const FatObstacles& member) { bytes += member.memory(); });
  return bytes + pieces_.memory() + reaches_.size() * NodeReach::memoryOf(pieces_.nodes().size());
}

std::size_t FatMembers::built() const {
  std::size_t count = 0;
  visit([&](const FatObstacles& member) { count += member.built(); });
  return count;
}

}  // namespace fcl_prob::detail
