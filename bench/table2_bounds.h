// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The rows of Table II that are bounds over convex parts: the paper's sums, and Hunter's.
#pragma once

#include "bench/table2_methods.h"

namespace fcl_prob::cli {

/// The printed sums over spheres, AABBs, kIOS, OBBs, 26-DOPs and hulls, the sum over AABBs of parts
/// in frames turned at random, the printed minimum over hulls, and Hunter's bound. Each adds up
/// what it says of every body and obstacle. Where a ball around each, or an OBB or 26-DOP that is
/// coarser than the row's own volume, gives less for a pair than its share of 1 - δ, that is what
/// counts.
std::vector<Table2Method> table2Bounds(const Table2Scene& scene, PartsStore& parts);

}  // namespace fcl_prob::cli
