// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Several obstacles, whose displacements are independent, asked one after the other.
#pragma once

#include <functional>
#include <vector>

#include "fcl_prob/robot_query.h"

namespace fcl_prob::detail {

/// Asks for P of one independent event of several. What it leaves in the result: bounds, or an
/// estimate besides.
using AskEvent =
    std::function<void(std::size_t event, const ProbabilityRequest& request, ProbabilityResult&)>;

/// P(any of `count` independent events). A threshold is tried first by the cheapest that can decide
/// it: each event against its share. The tolerance of each is that of the whole: with intervals
/// that are narrow relative to P so is that of 1 - Π(1 - P).
/// \param known  certified bounds of the events, if any; these may decide a threshold by themselves
RobotResult anyOfAsked(std::size_t count, const ProbabilityRequest& request, const AskEvent& ask,
                       std::vector<Bounds> known = {});

/// What the intervals of single events say of any of them.
using CombineEvents = std::function<Bounds(const std::vector<Bounds>& events)>;

/// The same for events of which only `combine` knows how they depend on each other; it must be at
/// most the sum. There is no estimate, and the tolerance is that of each event.
RobotResult anyOfDependent(std::size_t count, const ProbabilityRequest& request,
                           const AskEvent& ask, const CombineEvents& combine);

}  // namespace fcl_prob::detail
