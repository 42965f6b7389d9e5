// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Mass of a polygon under the normal distribution in the plane.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fcl_prob/bounds.h"

namespace fcl_prob::detail {

/// A polygon by its corners, anticlockwise.
using Polygon2 = std::vector<Eigen::Vector2d>;

/// Certified mass under N(0, I) of all polygons whose corners are within `displacement` of these,
/// along each axis: the flux of F = -e_b φ(a) Q(b), Q(b) = erfc(b/√2)/2, of which the divergence is
/// φ(a) φ(b), through the sides, e_b being about towards the nearest point or along what is thin.
/// What the polygon winds around twice counts twice.
Bounds polygonMass(const Polygon2& corners, const Eigen::Vector2d& displacement);

}  // namespace fcl_prob::detail
