// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The boundaries of sums of ellipsoids and a frustum, as patches.
#pragma once

#include <optional>
#include <vector>

#include "exact/curved_body.h"
#include "mass/surface_patch.h"

namespace fcl_prob::detail {

/// A sum of ellipsoids and a frustum, or two about the same axis, under a linear map of a positive
/// determinant.
struct CurvedSum {
  LongMatrix3 map;
  LongVector3 offset;  ///< of the middle, not yet mapped
  Frustum frustum;
  std::optional<Frustum> coaxial;
  LongMatrix3 frame;                    ///< of the frustum, right-handed, not yet mapped
  std::vector<LongMatrix3> ellipsoids;  ///< images of the unit ball, not yet mapped

  /// Of the middle, mapped.
  LongVector3 centre() const { return map * offset; }

  /// How far the surface's constants may be from those of the sum, in metres. Each coordinate is
  /// rounded next to the length that the map gives it, which is that of a metre at the most.
  double rounding() const;
};

/// Patches that close around the sum, by the normals' latitudes in the frustum's frame: along a
/// side they are those of its normals, beyond it the rims and ends are swept by the ellipsoids.
/// Along an edge that two patches share both are the same function of its corners, and each point
/// is the sum of points of the parts that have a normal in common but for its rounding, which moves
/// them along their surfaces: so the surface is within the sum (of the constants as they are
/// stored) and no deeper in it than the rounding.
std::vector<SurfacePatch> surfaceOf(const CurvedSum& sum);

}  // namespace fcl_prob::detail
