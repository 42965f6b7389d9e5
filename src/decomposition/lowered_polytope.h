// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A convex polytope that counts as smaller than it is, against rounding.
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <vector>

#include "decomposition/surface_piece.h"
#include "fcl_prob/convex_polytope.h"

namespace fcl_prob::detail {

/// A cut makes its points from two others: subtraction, quotient, product and sum. What of the
/// largest coordinate that may move them by; heights above planes are rounded by no more.
constexpr double kRoundingsOfCut = 16.0 * std::numeric_limits<double>::epsilon();

/// Half-spaces whose intersection is inside the polytope, deeper than `depth` (metres).
struct LoweredPolytope {
  LoweredPolytope(const ConvexPolytope& polytope, double depth);

  Eigen::AlignedBox3d box;  ///< of the polytope itself
  std::vector<CutPlane> faces;
};

/// The largest norm of a vertex of either.
double sizeOf(const TriangleMesh& mesh, const std::vector<ConvexPolytope>& polytopes);

}  // namespace fcl_prob::detail
