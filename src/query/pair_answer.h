// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The ladder of a pair: all ways to answer for two geometries, in their order.
#pragma once

#include "query/query_plan.h"
#include "query/upper_bounds.h"

namespace fcl_prob::detail {

/// \param plan  of planQuery(): which rungs serve
/// \throws UnsupportedGeometry before any work: open meshes as solids, octrees with unknown cells
ProbabilityResult pairAnswer(const QueryPlan& plan, const PlacedPair& pair,
                             const GaussianDisplacement& displacement,
                             const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
