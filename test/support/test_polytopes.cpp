// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "test_polytopes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace fcl_prob_test {
namespace {

using Eigen::Vector3d;
using fcl_prob::ConvexPolytope;

void setPlane(const ConvexPolytope& polytope, ConvexPolytope::Face& face) {
  const Vector3d& first = polytope.vertices[face.vertices[0]];
  Vector3d area = Vector3d::Zero();
  for (std::size_t k = 2; k < face.vertices.size(); ++k) {
    area += (polytope.vertices[face.vertices[k - 1]] - first)
                .cross(polytope.vertices[face.vertices[k]] - first);
  }
  face.normal = area.normalized();
  face.offset = -std::numeric_limits<double>::infinity();
  for (const Vector3d& v : polytope.vertices) {
    face.offset = std::max(face.offset, face.normal.dot(v));
  }
}

}  // namespace

ConvexPolytope boxPolytope(const Vector3d& lo, const Vector3d& hi,
                           const Eigen::Matrix3d& rotation) {
  ConvexPolytope box;
  for (int k = 0; k < 8; ++k) {
    const Vector3d corner(k & 1 ? hi.x() : lo.x(), k & 2 ? hi.y() : lo.y(),
                          k & 4 ? hi.z() : lo.z());
    box.vertices.push_back(rotation * corner);
  }
  const std::vector<std::vector<int>> loops{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                            {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (std::size_t f = 0; f < loops.size(); ++f) {
    const int axis = static_cast<int>(f) / 2;
    const double side = f % 2 == 0 ? -1 : 1;
    ConvexPolytope::Face face;
    face.normal = side * rotation.col(axis);
    face.offset = side < 0 ? -lo[axis] : hi[axis];
    face.vertices = loops[f];
    box.faces.push_back(face);
  }
  return box;
}

ConvexPolytope simplexPolytope(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                               const Vector3d& d) {
  ConvexPolytope simplex;
  simplex.vertices = {a, b, c, d};
  const bool is_positive = (b - a).dot((c - a).cross(d - a)) > 0;
  if (!is_positive) std::swap(simplex.vertices[1], simplex.vertices[2]);
  for (const std::vector<int>& loop :
       {std::vector<int>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
    simplex.faces.push_back({Vector3d::Zero(), 0, loop});
    setPlane(simplex, simplex.faces.back());
  }
  return simplex;
}

ConvexPolytope withVertices(const ConvexPolytope& polytope, const std::vector<Vector3d>& vertices) {
  ConvexPolytope result = polytope;
  result.vertices = vertices;
  for (ConvexPolytope::Face& face : result.faces) setPlane(result, face);
  return result;
}

double reach(const ConvexPolytope& polytope) {
  double farthest = 0;
  for (const Vector3d& v : polytope.vertices) farthest = std::max(farthest, v.norm());
  return farthest;
}

}  // namespace fcl_prob_test
