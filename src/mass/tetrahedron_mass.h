// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Mass of one tetrahedron under N(0, I).
#pragma once

#include <Eigen/Core>
#include <array>

#include "mass/boundary_mass.h"

namespace fcl_prob::detail {

/// A tetrahedron with corners anchor + corner[k]: offsets, so that a small one far from the origin
/// keeps its shape and can be bisected without loss.
struct Tetrahedron {
  Eigen::Vector3d anchor;
  std::array<Eigen::Vector3d, 4> corner;
  double volume = 0.0;
  double volume_error = 0.0;

  /// Of corners in either orientation.
  Tetrahedron(const Eigen::Vector3d& anchor, const std::array<Eigen::Vector3d, 4>& corner);

  /// Bounds on the density over the tetrahedron, by a half-space and by the farthest corner.
  double densityUpper() const;
  double densityLower() const;
};

/// How a tetrahedron is integrated: number of Gauss points in each of two directions (0 if none is
/// good enough) and a proven bound on the error of that.
struct CubaturePlan {
  unsigned points = 0;
  double error = 0.0;
};

/// The cheapest rule whose error is at most `tolerance`.
CubaturePlan planCubature(const Tetrahedron& tetrahedron, double tolerance);

MassWithError tetrahedronMass(const Tetrahedron& tetrahedron, const CubaturePlan& plan);

}  // namespace fcl_prob::detail
