// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Volume and first moment of the unit cube cut by a few planes.
#pragma once

#include <optional>

#include "convex/cut_polytope.h"

namespace fcl_prob::detail {

/// The half-space a·t >= r.
struct CubePlane {
  Eigen::Vector3d a;
  double r;
};

struct CutCube {
  double volume = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< ∫ t dt
};

/// Keeps its memory from one cube to the next.
class CubeCutter {
 public:
  CubeCutter();

  /// Of [0, 1]³ within all of the half-spaces; each number is off by less than kError. Nothing
  /// where rounding has torn the surface.
  std::optional<CutCube> cut(const CubePlane* planes, int count);

  /// A surface whose vertices are off by some ε, in volume and moment.
  static constexpr double kError = 1e-12;

 private:
  FaceSet cube_;
  FaceSet faces_;
  CutPolytope polytope_;
};

}  // namespace fcl_prob::detail
