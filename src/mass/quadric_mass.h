// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The mass of what a quadric leaves of a cell: a ball, an elliptic cylinder or a slab, whitened.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "mass/cell_mass.h"

namespace fcl_prob::detail {

/// { y : |axes (y - origin) + offset| <= 1 }
struct Quadric {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
};

/// Within a cell, { normal·y <= inner } is in the quadric and the quadric in { normal·y <= outer },
/// up to rounding; `steepness` is how fast the length changes along the normal.
struct QuadricLayer {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double inner = 0.0;
  double outer = 0.0;
  double steepness = 0.0;
};

/// Between the plane along the tangent at the cell's middle and that which bounds the bulge.
QuadricLayer layerOf(const Cell& cell, const Quadric& quadric);

/// Certified mass of the part of a cell of rank 3 that is in the quadric; nothing where the
/// boundary bends too much in the cell for that.
///
/// Along the axis that is steepest in the boundary the integral is closed, over the other two it is
/// Gauss-Legendre on the pieces where the integrand is analytic: where the boundary is between the
/// cell's ends along that axis. How far it may be continued to complex coordinates follows from the
/// gradient of the quadratic form there, and the error from that as in cellHalfSpaceMass().
/// \param slack  the boundary is where that length is 1 but for this
/// \param accuracy  relative to the cell's mass: how many nodes to spend
std::optional<Bounds> cellQuadricMass(const Cell& cell, const Quadric& quadric, double slack,
                                      double accuracy);

}  // namespace fcl_prob::detail
