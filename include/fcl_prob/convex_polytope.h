// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A closed convex polytope with its faces.
#pragma once

#include <fcl/geometry/shape/convex.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace fcl_prob {

/// A convex polytope given by its vertices and its faces. A body without volume (a point, a
/// segment, a flat polygon) has vertices but may have no faces.
struct ConvexPolytope {
  struct Face {
    Eigen::Vector3d normal;  ///< outward unit normal
    double offset = 0.0;  ///< max over the polytope of normal·y: the plane is normal·y = offset
    std::vector<int> vertices;  ///< indices into `vertices`, counter-clockwise seen from outside
  };

  std::vector<Eigen::Vector3d> vertices;
  std::vector<Face> faces;
};

/// Convex hull of a set of points (Qhull, in coordinates in which the set is about as wide in every
/// direction); facets that are coplanar within rounding are merged into one face. No point is
/// beyond the plane of a face, except for the rounding of normal·p; the vertices of a merged face
/// may lie below its plane by a few rounding errors of the largest coordinate (measured: up to
/// 5e-14 of it). A point set without volume gives its extreme points and no faces. May be called
/// from several threads at once. \throws InvalidGeometry if `points` is empty or has a non-finite
/// coordinate.
ConvexPolytope convexHull(const std::vector<Eigen::Vector3d>& points);

/// A polytope with faces for FCL, whose collide() and managers take it.
std::shared_ptr<fcl::Convexd> convexGeometry(const ConvexPolytope& polytope);

}  // namespace fcl_prob
