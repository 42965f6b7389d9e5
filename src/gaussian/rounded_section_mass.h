// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Mass of a polytope swept by a ball under a Gaussian of one or two dimensions.
#pragma once

#include "gaussian/rounded_polytope_mass.h"

namespace fcl_prob::detail {

/// Along which axes something moves, in the unit of the body.
struct MovingAxes {
  LongMatrix3 inverse;     ///< of the principal axes
  LongVector3 deviations;  ///< 0 beyond the rank
  int rank;                ///< 1 or 2
};

/// Certified mass of the body's section with the axes along which something moves: of rank 2 the
/// flux through the boundary of the plane section, by Gauss rules with a bound on their error, of
/// rank 1 that of an interval. At the worst [0, 1].
Bounds roundedSectionMass(const RoundedPolytope& body, const MovingAxes& axes,
                          const Interruption& interruption);

}  // namespace fcl_prob::detail
