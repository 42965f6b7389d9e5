// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Faces and edges of a polytope as seen from the origin, for integrals over its boundary.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "fcl_prob/convex_polytope.h"

namespace fcl_prob::detail {

/// A face with coordinates (a·y, b·y) in its plane; the foot of the origin has coordinates (0, 0).
struct FaceFrame {
  Eigen::Vector3d a, b, normal;  ///< right-handed
  double height = 0.0;           ///< normal·y of the plane; > 0 if the origin is on the inner side
  double deviation = 0.0;        ///< no vertex is farther from where the frame puts it
  double unevenness = 0.0;       ///< no vertex is farther from the plane of the others
  Eigen::Vector2d lo, hi;        ///< bounding rectangle
  double angle = 0.0;  ///< by which the contour turns around the foot: 0 or 2π, or in between
                       ///<   if the foot is a vertex

  double contour_distance = 0.0;  ///< from the foot to the contour

  Eigen::Vector2d coordinates(const Eigen::Vector3d& y) const { return {a.dot(y), b.dot(y)}; }
};

/// An edge as a side of one of its two faces. Along the edge, t is the position relative to the
/// foot of the origin on the edge's line.
struct EdgeSide {
  int face = 0;
  double inset =
      0.0;  ///< distance in the plane from the face's foot to the edge's line; > 0 inside
  double t_from =
      0.0;            ///< ends of the edge in the face's own coordinates: consistent with all other
  double t_to = 0.0;  ///<   edges of the face, so that angles around the foot add up exactly
  double mismatch = 0.0;     ///< |height² + inset² - distance²|: rounding
  double inset_error = 0.0;  ///< rounding of the inset
  double from_error = 0.0,
         to_error = 0.0;  ///< gap to the face's next edges: rounding, and that the
                          ///<   shared ends are not the face's own
};

/// ∫ dθ around the foot along a side from t_from to t_to. An inset of zero keeps its sign: the
/// limit from that side.
double angleBetween(double inset, double t_from, double t_to);

struct BoundaryEdge {
  double distance_squared = 0.0;  ///< from the origin to the edge's line
  double t_from = 0.0, t_to = 0.0;
  std::array<EdgeSide, 2> sides;
};

/// Distance from the face's foot to a side.
double footDistance(const EdgeSide& side);

struct PolytopeBoundary {
  std::vector<FaceFrame> faces;
  std::vector<BoundaryEdge> edges;
  double distance = 0.0;              ///< from the origin to the boundary, up to rounding
  std::optional<bool> origin_inside;  ///< of the convex body; nothing if that cannot be told
};

/// \throws InvalidGeometry if a vertex or normal is not finite, an index is out of range, or the
/// faces
///         do not close a surface.
PolytopeBoundary polytopeBoundary(const ConvexPolytope& polytope);

}  // namespace fcl_prob::detail
