// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Counting over random poses of the members of two groups.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "fcl_prob/probability_result.h"
#include "montecarlo/displaced_collider.h"

namespace fcl_prob::detail {

/// Where the members are in one sample, metres, world frame.
struct SampledPlacement {
  std::vector<fcl::Transform3d> poses_a;
  std::vector<fcl::Transform3d> poses_b;
};

/// Of sample `index`; called on any thread.
using PlacementSampler = std::function<SampledPlacement(std::size_t index)>;

using GeometryList = std::vector<std::shared_ptr<const fcl::CollisionGeometryd>>;

/// How often any member of A collides with any of B. \throws as monteCarloProbability()
ProbabilityResult placementMonteCarlo(const GeometryList& a, const GeometryList& b,
                                      const PlacementSampler& sampler,
                                      const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
