// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Polytopes given by slabs, such as k-DOPs and their Minkowski sums.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "convex/cut_polytope.h"
#include "convex/face_set.h"

namespace fcl_prob::detail {

/// The set { x : lower <= direction·x <= upper }.
struct Slab {
  Eigen::Vector3d direction;  ///< any length
  double lower;
  double upper;
};

/// The 13 directions of a 26-DOP in FCL's order (which stops earlier for its own KDOP<16>, 18 and
/// 24): x, y, z, x+y, x+z, y+z, x-y, x-z, y-z, x+y-z, x+z-y, y+z-x and, missing in FCL, x+y+z.
const std::vector<Eigen::Vector3d>& dopDirections();

/// Writes the faces of the intersection of slabs, of which the first three must be those of x, y
/// and z: their box, cut by one plane after another. The slabs are widened by `padding` (metres),
/// so that a flat body has faces too. O(k) faces are touched for k slabs.
void setToSlabs(const std::vector<Slab>& slabs, double padding, CutPolytope& work, FaceSet& faces);
void setToSlabs(const std::vector<Slab>& slabs, double padding, FaceSet& faces);

}  // namespace fcl_prob::detail
