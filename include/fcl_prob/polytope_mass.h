// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Exact masses of convex bodies under N(0, I).
#pragma once

#include <Eigen/Core>

#include "fcl_prob/bounds.h"
#include "fcl_prob/convex_polytope.h"

namespace fcl_prob {

/// Mass of a convex polytope under N(0, I), certified: `lower` and `upper` differ by the rounding margin
/// of the computation only. The origin may be outside, inside or on the boundary. Relative width about
/// 1e-12 from P = 0.5 to 1e-300. A polytope without volume has mass 0.
/// \param vertex_error  how far (whitened units) each vertex may be from the true one; widens the result.
/// Source: divergence theorem on each face (DESIGN section 3), Gauss-Legendre along each edge.
Bounds polytopeMass(const ConvexPolytope& polytope, double vertex_error = 0.0);

/// The half-space { y : normal·y >= offset }; |normal| = 1.
struct HalfSpace {
  Eigen::Vector3d normal;
  double offset;
};

/// Mass of box ∩ half-space under N(0, I), certified. The box may be unbounded.
Bounds boxHalfSpaceMass(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi, const HalfSpace& h);

/// Mass of box ∩ h1 ∩ h2 under N(0, I), certified. The box may be unbounded.
Bounds boxWedgeMass(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi, const HalfSpace& h1,
                    const HalfSpace& h2);

}  // namespace fcl_prob
