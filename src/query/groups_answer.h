// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The ladder of two groups: all ways to answer for the union of their pairs, in their order.
#pragma once

#include <string>
#include <vector>

#include "query/member_group.h"

namespace fcl_prob::detail {

/// Two groups with the poses of their members in the world frame.
struct PlacedGroups {
  const MemberGroup& a;
  const std::vector<fcl::Transform3d>& poses_a;
  const MemberGroup& b;
  const std::vector<fcl::Transform3d>& poses_b;
  std::string note;  ///< what they are, for the plan
};

/// At most one of the two has unbounded members.
/// \param ball  null: the displacement is not truncated; else the request is that of meeting and
/// being within it
/// \throws OpenMesh before any work
ProbabilityResult groupsAnswer(const PlacedGroups& groups, const GaussianDisplacement& displacement,
                               const ProbabilityRequest& request, const BallTruncation* ball);

}  // namespace fcl_prob::detail
