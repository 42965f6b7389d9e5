// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Integrals of the radial kernels along one edge of a polytope.
#pragma once

#include "mass/polytope_boundary.h"

namespace fcl_prob::detail {

/// What an edge adds to 4π times the mass, and bounds on its errors.
struct EdgeSum {
  double value = 0.0;
  double quadrature_error = 0.0;
  double rounding_error = 0.0;
  double field_length = 0.0;  ///< 4π ∫ |F| dt: flux lost for each unit by which the edge is off

  EdgeSum& operator+=(const EdgeSum& other);
};

/// Origin at `distance` >= kTailDistance from the boundary.
EdgeSum integrateTail(const PolytopeBoundary& boundary, const BoundaryEdge& edge);

/// Any origin; the error is absolute.
EdgeSum integrateCore(const PolytopeBoundary& boundary, const BoundaryEdge& edge);

inline constexpr double kTailDistance = 1.0;

}  // namespace fcl_prob::detail
