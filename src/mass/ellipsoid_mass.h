// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Mass of an ellipsoid under N(0, I), from quadrature over its slices.
#pragma once

#include <Eigen/Core>

#include "fcl_prob/bounds.h"

namespace fcl_prob::detail {

/// The image of a ball along its principal axes: centres >= 0, radii positive and ascending.
struct WhitenedBall {
  Eigen::Vector3d centre, radius;
  Eigen::Vector3d centre_error;  ///< absolute
  double z_pole = 0.0;           ///< centre - radius along z, without the rounding of a difference
  double z_pole_error = 0.0;
  double radius_error = 0.0;  ///< relative
};

/// Certified mass of the ellipsoid: its slices across the longest radius are ellipses, whose masses
/// have bounds. [0, 1] where a fixed number of slices does not do.
Bounds ellipsoidMass(const WhitenedBall& ball);

}  // namespace fcl_prob::detail
