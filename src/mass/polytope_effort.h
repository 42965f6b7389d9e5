// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The mass of a polytope for a caller who does not need all its digits, or not at any price.
#pragma once

#include "base/interruption.h"
#include "fcl_prob/polytope_mass.h"

namespace fcl_prob::detail {

struct MassEffort {
  /// The least relative width that the caller has a use for: the cubature that narrows a margin of
  /// rounding is left out, or made as coarse, where that is met.
  double enough = 0.0;

  /// When it is due, what is left to say is the mass of a box around the polytope.
  Interruption interruption;
};

/// polytopeMass() with so much effort.
Bounds polytopeMass(const ConvexPolytope& polytope, double vertex_error, const MassEffort& effort);

}  // namespace fcl_prob::detail
