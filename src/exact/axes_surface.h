// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The boundary of the sum of two cylinders, cones or segments, and ellipsoids, as patches.
#pragma once

#include <optional>

#include "exact/curved_surface.h"
#include "exact/normal_overlay.h"

namespace fcl_prob::detail {

/// A sum with a second axis.
struct AxesSum {
  CurvedSum sum;
  Frustum second;
  LongMatrix3 second_frame;

  /// How far the surface may be from the boundary, in metres.
  double rounding() const;
};

/// Patches that close around the sum, by its normals (normalOverlay()): within a region ends of
/// both axes stay, so that both rims and the ellipsoids are swept over its triangles. In a triangle
/// with a pole fans of normals go out from it, along each of which that axis's rim stays where it
/// is; the pole itself is a sector of the axis's disc. Along the circles the sides are, where they
/// cross parallelograms, and where a circle leads to a pole strips between the halves of a disc.
///
/// \return nothing where normalOverlay() has none
std::optional<std::vector<SurfacePatch>> axesSurface(const AxesSum& axes);

}  // namespace fcl_prob::detail
