// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How often the surface of a closed mesh winds around a point.
#pragma once

#include <functional>

#include "part.h"

namespace oracle {

/// A point to ask about.
struct Query {
  LongVector point;  ///< relative to the reference of the mesh
  LongVector error;  ///< bound on the error of its difference to a vertex of the mesh
  std::function<ExactVector()> exact;  ///< the point in the world, as the mesh stands there
};

/// Whether the closed mesh is filled at a point that is not on its surface: `touching` if it is.
/// The signed crossings of a ray are counted by exact signs of determinants; a ray through an edge
/// or a vertex is replaced by another one. \param exact_questions  counts what only rationals could
/// answer
Verdict isFilledAt(const Part& mesh, const Query& query, std::size_t& exact_questions);

}  // namespace oracle
