// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Two groups whose members are prepared: an interval, and its certificate.
#pragma once

#include <iosfwd>
#include <string>

#include "query/certificate_writer.h"
#include "query/member_group.h"

namespace fcl_prob::detail {

/// Of one side; `name` is what messages call it.
struct PlacedMembers {
  const MemberGroup& group;
  const std::vector<fcl::Transform3d>& poses;
  std::string name;
};

/// See certifiedProbability().
ProbabilityResult certifiedAnswer(const PlacedMembers& a, const PlacedMembers& b,
                                  const GaussianDisplacement& displacement,
                                  const ProbabilityRequest& request, std::ostream& out);

}  // namespace fcl_prob::detail
