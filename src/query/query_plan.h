// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Choosing how a query is answered.
#pragma once

#include <string>
#include <vector>

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/probability_request.h"
#include "query/prepared_geometry.h"

namespace fcl_prob::detail {

/// The code that answers.
enum class Route {
  single_collide,
  partition,
  unbounded_pair,
  exact_mass,
  convex_bound,
  general_pcd,
  monte_carlo,
  rare_event
};

/// What will be done: `route` says it to the program, `notes` to the reader of
/// ProbabilityResult::plan.
struct QueryPlan {
  Route route;

  std::vector<std::string> notes = {};

  /// Why not to look first if the bound of the root volumes is within the tolerance by itself;
  /// null: do, "": nobody would.
  const char* why_no_root_bound = "";

  /// Whether the partition is asked where the exact mass leaves more open than the tolerance, or
  /// has no gradient.
  bool partition_if_unresolved = false;

  /// Whether the exact mass is asked where the cells of a partition leave more open than that.
  bool exact_if_unresolved = false;

  /// The same of meshes, if they turn out to be convex.
  bool convex_meshes_if_unresolved = false;

  /// Why that is not asked before any cells are; null: it is, "": nobody would.
  const char* why_no_convex_meshes = "";
};

/// \throws UnsupportedGeometry if the method asked for cannot handle the pair.
QueryPlan planQuery(const PreparedGeometry& a, const PreparedGeometry& b,
                    const GaussianDisplacement& displacement, const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
