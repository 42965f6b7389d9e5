// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Regions, and hyperplanes between a region and what two pieces touch at.
#pragma once

#include <vector>

#include "objects.h"
#include "polytope.h"

namespace verify {

/// The open set `box ∩ half-spaces`. Beyond the rank it is flat, at zero.
struct Region {
  Region(int rank, const Vec& lo, const Vec& hi);
  Region(const Polytope& polytope, const Vec& lo, const Vec& hi, const std::vector<Plane>& planes);
  /// A corner times a positive number, to have no division and so no rounding.
  struct Corner {
    BallVec point;
    Ball times;
  };
  Corner exact_corner(std::size_t i) const;

  Vec bound{};                    // of |y|
  std::vector<Vec> normals;       // of its planes, but for the sides of the box
  std::vector<Vec> corners;       // rounded
  std::vector<ExactPoint> exact;  // the corners exactly; none where the region is a box
};

/// What a normal says exactly of `L - K` and of the displacements.
struct Heights {
  Heights(const Frame& frame, const Object& a, const Piece& k, const Object& b, const Piece& l,
          const BallVec& normal);
  /// Times the corner's factor.
  Ball at(const Region::Corner& corner) const {
    return dot(slope, corner.point) + constant * corner.times;
  }

  Ball lo, hi;  // of L - K
  BallVec slope;
  Ball constant;
};

/// Looks for a hyperplane that proves that pieces k of a and l of b touch nowhere in the region;
/// false: there is none, or none that can be told from one that does not.
bool separates(const Frame& frame, const Region& region, const Object& a, const Piece& k,
               const Object& b, const Piece& l);

}  // namespace verify
