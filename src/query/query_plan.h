// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Choosing how a query is answered.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <string>
#include <vector>

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/probability_request.h"

namespace fcl_prob::detail {

/// What will be done: `route` says it to the program, `notes` to the reader of
/// ProbabilityResult::plan.
struct QueryPlan {
  enum class Route { single_collide, monte_carlo };
  Route route;
  std::vector<std::string> notes;
};

/// \throws UnsupportedGeometry if the method asked for cannot handle the pair.
QueryPlan planQuery(const fcl::CollisionGeometryd& a, const fcl::CollisionGeometryd& b,
                    const GaussianDisplacement& displacement, const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
