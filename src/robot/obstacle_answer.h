// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Several events, as contacts with obstacles or at waypoints, of which each is asked by itself.
#pragma once

#include <vector>

#include "fcl_prob/robot_query.h"
#include "query/parts_loop.h"

namespace fcl_prob::detail {

/// P(any of several independent events), asked one by one. A threshold is tried first by the
/// cheapest that can decide it: each event against its share. The tolerance of each is that of the
/// whole: with intervals that are narrow relative to P so is that of 1 - Π(1 - P).
/// \param known  certified bounds of the events, as many as there are
/// \param ask    leaves bounds, or an estimate besides
RobotResult anyOfAsked(std::vector<Bounds> known, const ProbabilityRequest& request,
                       const PartsLoop::Ask& ask);

/// The same for events of which only `combine` knows how they depend on each other; it must be at
/// most the sum. There is no estimate, and the tolerance is that of each event.
RobotResult anyOfDependent(std::vector<Bounds> known, const ProbabilityRequest& request,
                           const PartsLoop::Ask& ask, const PartsLoop::Combine& combine);

}  // namespace fcl_prob::detail
