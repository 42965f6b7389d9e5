// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Two groups whose members are prepared: an interval, and its certificate.
#pragma once

#include <iosfwd>

#include "query/member_group.h"

namespace fcl_prob::detail {

/// One side.
struct PlacedMembers {
  const MemberGroup& group;
  const std::vector<fcl::Transform3d>& poses;
};

/// Of groups that are not empty. \throws as certifiedProbability(), but for poses
ProbabilityResult certifiedAnswer(const PlacedMembers& a, const PlacedMembers& b,
                                  const GaussianDisplacement& displacement,
                                  const ProbabilityRequest& request, std::ostream& certificate);

}  // namespace fcl_prob::detail
