// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Mass of a small polytope under N(0, I) by cubature over tetrahedra: a sum of positive terms.
#pragma once

#include <optional>

#include "fcl_prob/convex_polytope.h"
#include "mass/boundary_mass.h"
#include "mass/polytope_effort.h"

namespace fcl_prob::detail {

struct SolidMass {
  MassWithError mass;
  double cut_error = 0.0;  ///< how far cutting may have moved a point of the surface
};

/// Mass of the tetrahedra that one vertex of the polytope spans with the faces that it is not on.
/// They fill the polytope as far as its faces are plane (see FaceFrame::unevenness). Unlike
/// boundaryMass() nothing cancels, however small the polytope is against its distance from the
/// origin; but a polytope of many standard deviations takes many pieces. `lower_bound` of the mass
/// (0 if unknown) tells which pieces do not matter. Returns nothing if more than `max_pieces`
/// pieces are needed or the effort's interruption is due.
///
/// Over a tetrahedron one direction is integrated in closed form and two by a Gauss rule whose
/// error is bounded by the size of the density on a Bernstein ellipse; the polytope is cut in
/// halves until that bound is within rounding, or far below what is enough.
std::optional<SolidMass> solidMass(const ConvexPolytope& polytope, double lower_bound,
                                   int max_pieces, const MassEffort& effort = {});

}  // namespace fcl_prob::detail
