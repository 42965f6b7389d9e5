// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex polytopes whose vertices are known to more than a double holds.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/constants.h"
#include "fcl_prob/convex_polytope.h"
#include "gaussian/long_vector.h"

namespace fcl_prob::detail {

/// Faces as those of a ConvexPolytope: closed, oriented outwards.
struct LongPolytope {
  struct Face {
    LongVector3 normal;  ///< unit; of a face without area anything across its longest edge
    std::vector<int> vertices;
  };

  std::vector<LongVector3> vertices;
  std::vector<Face> faces;

  /// Sets the normals from the vertices.
  void findNormals();

  /// No coordinate is farther from 0, of each axis.
  LongVector3 extent() const;

  /// Seen from a point, with vertices rounded to doubles.
  ConvexPolytope seenFrom(const LongVector3& point) const;
};

/// How far withinCube() moves a vertex from the edge that it is on, along each axis in units of the
/// extent: six cuts of 8 halves of kLongEpsilon.
inline constexpr double kCutOffRounding = 24.0 * kLongEpsilon;

/// What is left of a polytope within the cube [-reach, reach]³; no faces if nothing is. Nothing if
/// the faces do not close to the last edge.
std::optional<LongPolytope> withinCube(LongPolytope polytope, long double reach);

/// What of a polytope weighs anything under N(0, I).
struct HeavyPart {
  LongPolytope polytope;
  Eigen::Vector3d cut_error =
      Eigen::Vector3d::Zero();  ///< by which cutting may have moved the surface along each axis
  double reach = kInfinity;     ///< what is left out is beyond it, along an axis
};

/// Of a polytope of many deviations the part around the point nearest to the origin: rounding moves
/// its corners the less, the nearer they are.
HeavyPart heavyPart(const LongPolytope& polytope);

}  // namespace fcl_prob::detail
