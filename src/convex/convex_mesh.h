// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A convex polytope with the adjacency that a Minkowski sum needs.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fcl_prob/convex_polytope.h"

namespace fcl_prob::detail {

/// A convex polytope of any dimension: a solid; a polygon, which has two faces, one for each side;
/// a segment, which has one edge and no faces; a point.
struct ConvexMesh {
  struct Face {
    Eigen::Vector3d normal;  ///< outward, unit
    int first;               ///< into `corners`
    int count;
  };

  /// Walked from `from` to `to` by the face `left`, the other way by the face `right`; both are -1
  /// for a segment.
  struct Edge {
    int from;
    int to;
    int left;
    int right;
  };

  std::vector<Eigen::Vector3d> vertices;
  std::vector<Face> faces;
  std::vector<int> corners;  ///< of all faces, counter-clockwise seen from outside
  std::vector<Edge> edges;

  /// The body that was meant reaches out of the faces by no more than this (metres): 0 or rounding.
  double slack = 0.0;

  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const;
};

/// \throws InvalidGeometry if the faces do not close a surface.
ConvexMesh makeConvexMesh(const ConvexPolytope& polytope);

/// The convex hull of some points, of whatever dimension they span.
/// \throws InvalidGeometry if there are none, or one is not finite.
ConvexMesh makeConvexMesh(const std::vector<Eigen::Vector3d>& points);

/// The same of a hull that is known.
ConvexMesh makeConvexMesh(const ConvexPolytope& hull, const std::vector<Eigen::Vector3d>& points);

/// A triangle, which may be degenerate to a segment or a point.
ConvexMesh makeTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                        const Eigen::Vector3d& c);

/// The reflection -R·mesh, written to `image` (whose memory is reused).
void reflect(const ConvexMesh& mesh, const Eigen::Matrix3d& rotation, ConvexMesh& image);

}  // namespace fcl_prob::detail
