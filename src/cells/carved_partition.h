// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The partition of the displacement space where one of two meshes is convex.
#pragma once

#include "base/budget.h"
#include "base/ladder.h"
#include "scene/scene.h"

namespace fcl_prob::detail {

/// Why carve() is not for such a query; null if it is.
const char* whyNotCarved(const QueryScene& scene, const ProbabilityRequest& request);

/// As partitionProbability(), but for the decision and `plan`, where it is for such a query. Not
/// answered where that does not reach what the request asks for, so that the boxes of the other
/// partition are to be tried: the interval, if there is one, and the statistics are those so far.
Climbed carve(const QueryScene& scene, const ProbabilityRequest& request, Budget& budget,
              ProbabilityResult& result);

}  // namespace fcl_prob::detail
