// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Masses and first moments of a cell cut by one plane, fast enough for the partition's inner loop.
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "base/constants.h"
#include "convex/slab_kernels.h"
#include "fcl_prob/bounds.h"

namespace fcl_prob::detail {

/// An axis-aligned cell [lo, hi] of the whitened frame. Along the axes from `rank` on the
/// displacement does not move: there lo = hi = 0 and the axis has mass 1.
struct Cell {
  Eigen::Vector3d lo;
  Eigen::Vector3d hi;
  int rank;
  bool settled =
      false;  ///< nothing is left of it, whatever its extents (a cell of rank 0 has none)

  CellBox box() const;

  /// Without interior along an axis that moves, or settled.
  bool empty() const {
    for (int i = 0; i < rank; ++i) {
      if (!(lo[i] < hi[i])) return true;
    }
    return settled;
  }

  /// Along the axes that move.
  double largestWidth() const {
    double width = 0.0;
    for (int i = 0; i < rank; ++i) width = std::max(width, hi[i] - lo[i]);
    return width;
  }

  /// Along the axes that move; infinite if none does.
  double leastWidth() const {
    double width = kInfinity;
    for (int i = 0; i < rank; ++i) width = std::min(width, hi[i] - lo[i]);
    return width;
  }

  /// The largest |y_k| of its points, for each axis.
  Eigen::Vector3d largestCoordinates() const { return lo.cwiseAbs().cwiseMax(hi.cwiseAbs()); }

  /// The corner where m·y is least.
  Eigen::Vector3d lowestCorner(const Eigen::Vector3d& m) const {
    return (m.array() > 0).select(lo, hi);
  }
};

/// Certified mass of the cell under N(0, I).
Bounds cellMass(const Cell& cell);

/// ∫ y φ(y) dy over the cell, to within rounding.
Eigen::Vector3d cellMoment(const Cell& cell);

/// Certified mass of cell ∩ { m·y >= s }, |m| = 1.
///
/// Along the axis in which m is largest the integral is closed (a difference of normal tails); over
/// the other two it is Gauss-Legendre on the pieces where the integrand is analytic. The quadrature
/// error is bounded through the integrand's size on a Bernstein ellipse, |error| <= 64/15 M ρ^-2n /
/// (1 - ρ^-2) (Trefethen, Approximation Theory and Approximation Practice, theorem 19.3), never
/// estimated.
/// \param accuracy  relative to the cell's mass: how many nodes to spend
Bounds cellHalfSpaceMass(const Cell& cell, const Eigen::Vector3d& m, double s, double accuracy);

/// ∫ y φ(y) dy over a set, with a bound on the error of every component.
struct Moment {
  Eigen::Vector3d value;
  double error;
};

/// Over cell ∩ { m·y >= s }, by the same quadrature.
Moment cellHalfSpaceMoment(const Cell& cell, const Eigen::Vector3d& m, double s);

}  // namespace fcl_prob::detail
