// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/convex_piece.h"

#include <algorithm>
#include <cmath>

#include "fcl_prob/convex_polytope.h"

namespace fcl_prob::detail {
namespace {

// Exact but for components below 1e-308 of the largest.
Eigen::Vector3d scaledToOne(const Eigen::Vector3d& v) {
  int exponent = 0;
  std::frexp(v.cwiseAbs().maxCoeff(), &exponent);
  return v.unaryExpr([exponent](double x) { return std::ldexp(x, -exponent); });
}

// Whether two vectors are parallel but for one rounding of each component. That stays so however a
// linear map stretches them, and counts as what edges are rounded by.
bool areParallel(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  for (int k = 0; k < 3; ++k) {
    const int u = (k + 1) % 3, v = (k + 2) % 3;
    if (a[u] * b[v] != a[v] * b[u]) return false;
  }
  return true;
}

// Adds the direction unless one that is known is parallel to it; says whether it did.
bool addDirection(const Eigen::Vector3d& along, std::vector<Eigen::Vector3d>& known) {
  const Eigen::Vector3d direction = scaledToOne(along);
  const bool old = std::any_of(known.begin(), known.end(), [&](const Eigen::Vector3d& other) {
    return areParallel(direction, other);
  });
  if (!old) known.push_back(direction);
  return !old;
}

// Whether p × q keeps nearly all of its digits.
bool isWellShaped(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
  return p.cross(q).norm() > 0.25 * p.norm() * q.norm();
}

// Faces and edges of the hull; parallel ones once, since a slab has two sides. Nearly parallel ones
// all stay: what is near before whitening need not be after it.
ConvexPiece pieceOfHull(const ConvexPolytope& hull) {
  ConvexPiece piece{{hull.vertices, 0}, {}, {}};
  std::vector<Eigen::Vector3d> normals;
  std::vector<Eigen::Vector3d> directions;
  for (const ConvexPolytope::Face& face : hull.faces) {
    const int count = static_cast<int>(face.vertices.size());
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3d edge =
          hull.vertices[face.vertices[(i + 1) % count]] - hull.vertices[face.vertices[i]];
      if (addDirection(edge, directions)) piece.addEdge(edge);
    }
    const Eigen::Vector3d& corner = hull.vertices[face.vertices[0]];
    const Eigen::Vector3d p = hull.vertices[face.vertices[1]] - corner;
    const Eigen::Vector3d q = hull.vertices[face.vertices[count - 1]] - corner;
    if (isWellShaped(p, q) && !addDirection(p.cross(q), normals)) continue;
    piece.addFace(p, q);
  }
  return piece;
}

// A hull without volume: every pair of vertices may be an edge, which gives more slabs than needed
// and none too few.
ConvexPiece pieceOfFlatHull(const ConvexPolytope& hull) {
  ConvexPiece piece{{hull.vertices, 0}, {}, {}};
  const int count = static_cast<int>(hull.vertices.size());
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < i; ++j) piece.addEdge(hull.vertices[i] - hull.vertices[j]);
  }
  for (std::size_t i = 1; i < piece.edges.size(); ++i) {
    piece.faces.emplace_back(piece.edges[0], piece.edges[i]);
  }
  return piece;
}

}  // namespace

ConvexPiece ConvexPiece::mapped(const Eigen::Matrix3d& linear,
                                const Eigen::Matrix3d& magnitudes) const {
  const auto edge = [&](const PieceEdge& of) {
    return PieceEdge{linear * of.along, magnitudes * of.magnitude};
  };
  ConvexPiece image{body.transformed(linear), {}, {}};
  for (const auto& [p, q] : faces) image.faces.emplace_back(edge(p), edge(q));
  for (const PieceEdge& of : edges) image.edges.push_back(edge(of));
  return image;
}

ConvexPiece polytopePiece(const std::vector<Eigen::Vector3d>& points) {
  const ConvexPolytope hull = convexHull(points);
  return hull.faces.empty() ? pieceOfFlatHull(hull) : pieceOfHull(hull);
}

ConvexPiece cubePiece(double side) {
  ConvexPiece piece;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      for (const double z : {-0.5, 0.5})
        piece.body.points.emplace_back(side * x, side * y, side * z);
    }
  }
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d edge = side * Eigen::Vector3d::Unit(k);
    piece.addEdge(edge);
    piece.addFace(edge, side * Eigen::Vector3d::Unit((k + 1) % 3));
  }
  return piece;
}

}  // namespace fcl_prob::detail
