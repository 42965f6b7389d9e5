// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What queries and calls of fcl::collide take, to choose between them: microseconds of some
// machine. Not measured when they run, so that what is chosen is the same every time.
#pragma once

#include "montecarlo/placement_collider.h"

namespace fcl_prob::detail {

/// One call of fcl::collide for all members of both groups.
double collideCost(const GeometryList& a, const GeometryList& b);

/// A query with little to do, for all members of both groups.
double leastQueryCost(const GeometryList& a, const GeometryList& b);

}  // namespace fcl_prob::detail
