// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Counting over random poses of the members of two groups.
#pragma once

#include <cstddef>
#include <functional>

#include "fcl_prob/probability_result.h"
#include "sampling/placement_collider.h"

namespace fcl_prob::detail {

/// Of sample `index`; called on any thread.
using PlacementSampler = std::function<SampledPlacement(std::size_t index)>;

/// How often any member of A collides with any of B. \throws as monteCarloProbability()
ProbabilityResult placementMonteCarlo(const GeometryList& a, const GeometryList& b,
                                      const PlacementSampler& sampler,
                                      const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
