// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A closed convex polytope with its faces.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace fcl_prob {

/// A convex polytope given by its vertices and its faces. A body without volume (a point, a segment, a
/// flat polygon) has vertices but may have no faces.
struct ConvexPolytope {
  struct Face {
    Eigen::Vector3d normal;     ///< outward unit normal
    double offset = 0.0;        ///< max over the vertices of normal·v: the plane is normal·y = offset
    std::vector<int> vertices;  ///< indices into `vertices`, counter-clockwise seen from outside
  };

  std::vector<Eigen::Vector3d> vertices;
  std::vector<Face> faces;
};

/// Convex hull of a set of points (Qhull); coplanar facets are merged into one face. A point set without
/// volume gives its extreme points and no faces.
/// \throws InvalidGeometry if `points` is empty or has a non-finite coordinate.
ConvexPolytope convexHull(const std::vector<Eigen::Vector3d>& points);

}  // namespace fcl_prob
