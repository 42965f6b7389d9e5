// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Curved shapes as sums of an ellipsoid and a frustum, of which C-obstacles are sums again.
#pragma once

#include <optional>

#include "convex/convex_set.h"
#include "fcl_prob/convex_body.h"
#include "mass/rounded_parts.h"

namespace fcl_prob::detail {

/// { (x, y, z) : |z| <= half_height, |(x, y)| <= radius at z, linear between both ends }. A
/// cylinder, a cone, a segment (no radii).
struct Frustum {
  double half_height = 0.0, bottom = 0.0, top = 0.0;

  /// No point is farther from the middle of the axis than that.
  double size() const { return half_height + (bottom > top ? bottom : top); }

  /// Of the largest ball around the middle of the axis that is within.
  double inradius() const;
};

/// A body that is the sum of a frustum and an ellipsoid around the origin of its frame, either of
/// which may be missing. World axes, metres.
struct CurvedBody {
  std::optional<Frustum> frustum;
  LongMatrix3 frame = LongMatrix3::Identity();  ///< of the frustum: its axis is the third column
  std::optional<LongMatrix3> ellipsoid;         ///< image of the unit ball
  double least_axis = 0.0;                      ///< of the ellipsoid, no more than that
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< in the frame of the geometry
};

/// An ellipsoid, a sphere, a capsule, a cylinder or a cone; nothing for other bodies.
std::optional<CurvedBody> curvedBody(const ConvexBody& body, const Eigen::Matrix3d& rotation);

/// The body as a shape with a support function.
SupportShape shapeOf(const ConvexBody& body);

}  // namespace fcl_prob::detail
