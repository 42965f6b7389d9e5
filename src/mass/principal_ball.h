// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Mass of a ball under any Gaussian of one to three dimensions.
#pragma once

#include <array>

#include "fcl_prob/bounds.h"
#include "fcl_prob/gaussian_displacement.h"

namespace fcl_prob::detail {

/// A ball along the principal axes of a displacement, seen from its mean. Metres.
struct PrincipalBall {
  std::array<long double, 3> centre;
  double centre_error = 0.0;  ///< of each coordinate, absolute
  long double radius = 0.0L;
  double radius_error = 0.0;  ///< absolute
};

/// Certified mass under a displacement of rank 1 to 3, its mean left out (the ball is seen from
/// there). Its relative width is below 1e-10 where the errors of the ball allow it, the mass is
/// above 1e-280 and no deviation is below 1e-3 of the radius. There is no iteration to converge:
/// where a fixed number of nodes is not enough the bounds are wide, at the worst [0, 1].
Bounds principalBallMass(const PrincipalBall& ball, const GaussianDisplacement& displacement);

}  // namespace fcl_prob::detail
