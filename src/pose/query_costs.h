// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What queries and calls of fcl::collide take, to choose between them: microseconds of some
// machine. Not measured when they run, so that what is chosen is the same every time.
#pragma once

#include "montecarlo/placement_collider.h"

namespace fcl_prob::detail {

/// One call of fcl::collide for all members of both groups.
double collideCost(const GeometryList& a, const GeometryList& b);

/// An answer to a query, for all members of both groups.
struct QueryCost {
  double least = 0.0;  ///< with little to do
  double rough = 0.0;  ///< more than that, of one to some percent
};

QueryCost queryCost(const GeometryList& a, const GeometryList& b);

}  // namespace fcl_prob::detail
