// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What the C-obstacle of a curved pair is a sum of.
#pragma once

#include <optional>

#include "exact/curved_surface.h"

namespace fcl_prob::detail {

/// B ⊕ (−A), not yet mapped, and a ball within it.
struct CurvedParts {
  CurvedSum sum;                  ///< its map and offset are not set
  std::optional<Frustum> second;  ///< with another axis
  LongMatrix3 second_frame;
  std::optional<ConvexMesh> polytope;                ///< a part of the sum, in the frustum's frame
  double inradius = 0.0;                             ///< metres
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< of the ball, in the frustum's frame
  double error = 0.0;  ///< how far the parts may be from the true ones, metres
};

/// Whether curvedParts() knows the pair.
bool haveCurvedParts(const ConvexBody& a, const ConvexBody& b);

/// Of ellipsoids, spheres, capsules, cylinders and cones, or of a cylinder or a cone and a
/// polytope; nothing for other pairs. Parts are those of the bodies turned by their rotations.
/// \param attempt  a polytope, or the second of two axes, is turned by the perturbation() of this
///                 number, which counts as error
std::optional<CurvedParts> curvedParts(const ConvexBody& a, const Eigen::Matrix3d& rotation_a,
                                       const ConvexBody& b, const Eigen::Matrix3d& rotation_b,
                                       int attempt);

}  // namespace fcl_prob::detail
