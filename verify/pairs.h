// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Whether two pieces touch nowhere, or everywhere, in a region.
#pragma once

#include <vector>

#include "objects.h"
#include "polytope.h"

namespace verify {

/// Looks for a hyperplane that proves that pieces k of a and l of b touch nowhere in the region;
/// false: there is none, or none that can be told from one that does not.
bool separates(const Frame& frame, const Region& region, const Object& a, const Piece& k,
               const Object& b, const Piece& l);

/// The half-spaces of which `L - K` is the intersection: planes that support it on both sides,
/// among them all of its faces.
class Faces {
 public:
  Faces(const Frame& frame, const Object& a, const Piece& k, const Object& b, const Piece& l);
  /// Whether `L - K` has an inside and certainly contains the displacements of the region.
  bool contain(const Region& region) const;

 private:
  struct Slab {
    BallVec slope;  // of the height over y
    Ball lo, hi;    // of L - K
  };
  bool has_inside_ = false;
  std::vector<Slab> slabs_;
};

}  // namespace verify
