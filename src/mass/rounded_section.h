// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The section of a polytope swept by a ball with a plane: a convex region bounded by segments and
// arcs of ellipses.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fcl_prob/convex_polytope.h"
#include "mass/rounded_parts.h"

namespace fcl_prob::detail {

/// A piece of the boundary of a section: a segment, or centre + image g/|g|, g between two vectors.
struct SectionPiece {
  LongVector3 from, to;  ///< its ends
  bool is_arc = false;
  LongVector3 centre;
  LongMatrix3 image;
  LongVector3 first, last;  ///< g at the ends
};

/// Anticlockwise about the plane's normal, the origin of the core being the origin. Each begins
/// where the last one ends, but for the rounding of arcs.
struct RoundedSection {
  std::vector<SectionPiece> pieces;  ///< none if the plane misses the body
  double defect = 0.0;  ///< by how much less than the radius points may be off the core
};

/// A plane { x : normal·(x + origin) = 0 }, the normal being of length 1.
struct SectionPlane {
  LongVector3 normal, origin;
};

/// The boundary of core ⊕ ball is made of faces, moved outwards, of cylinders around edges and
/// spheres around corners. The plane crosses their borders where heights above it change their
/// sign; heights at the corners of cells and crossings are computed once or in the same way for
/// both neighbours, so that the pieces close whatever rounding does.
///
/// \param normals  of the core's faces
/// \return nothing if cells have more crossings than convex ones can
std::optional<RoundedSection> roundedSection(const ConvexPolytope& core,
                                             const std::vector<Eigen::Vector3d>& normals,
                                             double radius, const SectionPlane& plane);

}  // namespace fcl_prob::detail
