// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "decomposition/lowered_polytope.h"

#include <algorithm>
#include <limits>

namespace fcl_prob::detail {

LoweredPolytope::LoweredPolytope(const ConvexPolytope& polytope, double depth) {
  for (const Eigen::Vector3d& v : polytope.vertices) box.extend(v);
  for (const ConvexPolytope::Face& face : polytope.faces) {
    // A segment from the middle to a point outside leaves through some face, where it is no lower
    // than that face's lowest corner: so points below all of those are inside.
    double lowest = std::numeric_limits<double>::infinity();
    for (const int corner : face.vertices) {
      lowest = std::min(lowest, face.normal.dot(polytope.vertices[corner]));
    }
    faces.push_back({face.normal, lowest - depth});
  }
}

double sizeOf(const TriangleMesh& mesh, const std::vector<ConvexPolytope>& polytopes) {
  double size = 0.0;
  for (const fcl::Vector3d& v : mesh.vertices) size = std::max(size, v.stableNorm());
  for (const ConvexPolytope& polytope : polytopes) {
    for (const Eigen::Vector3d& v : polytope.vertices) size = std::max(size, v.stableNorm());
  }
  return size;
}

}  // namespace fcl_prob::detail
