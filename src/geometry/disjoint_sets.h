// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Sets of vertices or triangles that hang together.
#pragma once

#include <boost/pending/disjoint_sets.hpp>

namespace fcl_prob::detail {

/// Starts with every index below the constructor's argument in a set of its own; `union_set` joins
/// two, `find_set` names the one that an index is in.
using DisjointSets = boost::disjoint_sets_with_storage<>;

}  // namespace fcl_prob::detail
