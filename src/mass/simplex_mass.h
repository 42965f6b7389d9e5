// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Certified masses of small tetrahedra under N(0, I), quickly rather than to the last digit.
#pragma once

#include <Eigen/Core>
#include <array>

#include "fcl_prob/bounds.h"

namespace fcl_prob::detail {

/// How well a mass is to be known, per tetrahedron: within `relative` of its own mass, or within
/// `absolute`.
struct MassAccuracy {
  double relative;
  double absolute = 0.0;
};

/// A sum of signed masses of tetrahedra. A cubature of degree 5 or 9 with positive weights is off
/// by no more than twice what is left out of the density's Taylor series about the middle behind
/// that degree; a tetrahedron for which that is too much is halved. Rounding: (32 + 4 y²) ε, since
/// a node is off by a few ε of |y|, which changes exp(-y²/2) by a few ε y² of itself, and all terms
/// are positive.
class SimplexMass {
 public:
  using Corners = std::array<Eigen::Vector3d, 4>;

  void add(const Corners& corners, const MassAccuracy& accuracy, int halvings = 0);

  Bounds bounds() const;

 private:
  void addHalves(const Corners& corners, const MassAccuracy& accuracy, int halvings);

  double mass_ = 0.0;
  double error_ = 0.0;
};

}  // namespace fcl_prob::detail
