// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Mass of a polytope swept by a ball under a Gaussian of two dimensions.
#pragma once

#include "mass/rounded_polytope_mass.h"

namespace fcl_prob::detail {

/// Something moves along the first two of three principal axes.
struct MovingAxes {
  LongMatrix3 inverse;     ///< of the axes
  LongVector3 deviations;  ///< in the unit of the body; the third one is 0
};

/// Certified mass of the body's section with the plane in which it moves: the flux through the
/// boundary, by Gauss rules with a bound on their error. At the worst [0, 1].
Bounds roundedSectionMass(const RoundedPolytope& body, const MovingAxes& axes,
                          const Interruption& interruption);

}  // namespace fcl_prob::detail
