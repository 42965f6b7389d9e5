// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Groups of convex members that hardly get into each other's way.
#pragma once

#include <optional>
#include <vector>

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"
#include "query/member_group.h"

namespace fcl_prob::detail {

/// The probability that any pair of convex members meets, from their exact masses P_i:
/// Σ P_i - Σ P_ij <= P <= Σ P_i, where what two C-obstacles have in common weighs P_ij, no more
/// than a box around it. Nothing where that does not answer the request, which is seen before most
/// masses are computed: C-obstacles that overlap are for the partition.
std::optional<ProbabilityResult> unionOfPairs(const MemberGroup& a,
                                              const std::vector<fcl::Transform3d>& poses_a,
                                              const MemberGroup& b,
                                              const std::vector<fcl::Transform3d>& poses_b,
                                              const GaussianDisplacement& displacement,
                                              const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
