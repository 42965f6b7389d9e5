// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/fat_members.h"

#include <algorithm>

namespace fcl_prob::detail {

FatMembers::FatMembers(const WhitenedPair& pair, const PartitionObject& body, bool fan_is_a,
                       const Eigen::Matrix3d& matrix)
    : first_faces_{0} {
  for (std::size_t i = 0; i < body.parts.size(); ++i) {
    members_.emplace_back(pair, body.tree->parts[i], fan_is_a,
                          matrix * body.parts[i].pose.linear());
    first_faces_.push_back(first_faces_.back() + members_.back().faceCount());
  }
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
