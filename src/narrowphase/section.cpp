// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "narrowphase/section.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "cobstacle/convex_mesh.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob::detail {
namespace {

using Points = std::vector<Eigen::Vector3d>;
using Segments = std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>;

Segments edgesOf(const FaceSet& faces) {
  Segments edges;
  for (std::size_t f = 0; f < faces.faceCount(); ++f) {
    const int count = faces.cornerCount(f);
    for (int i = 0; i < count; ++i) {
      edges.emplace_back(faces.position(f, i), faces.position(f, (i + 1) % count));
    }
  }
  if (!edges.empty()) return edges;
  for (const Eigen::Vector3d& a : faces.vertices()) {  // a point or a segment
    for (const Eigen::Vector3d& b : faces.vertices()) edges.emplace_back(a, b);
  }
  return edges;
}

Segments edgesOf(const Points& points) {
  Segments edges;
  if (points.empty()) return edges;
  const ConvexMesh hull = makeConvexMesh(points);
  for (const ConvexMesh::Edge& edge : hull.edges) {
    edges.emplace_back(hull.vertices[edge.from], hull.vertices[edge.to]);
  }
  if (edges.empty()) edges.emplace_back(hull.vertices[0], hull.vertices[0]);
  return edges;
}

/// Extreme points of the part of a body within |coordinate| <= band, projected to coordinate = 0.
Points sectionPoints(const Segments& edges, int coordinate, double band) {
  Points points;
  const auto add = [&](Eigen::Vector3d p) {
    p[coordinate] = 0.0;
    points.push_back(p);
  };
  for (const auto& [a, b] : edges) {
    const double from = a[coordinate];
    const double to = b[coordinate];
    if (std::abs(from) <= band) add(a);
    if (std::abs(to) <= band) add(b);
    for (const double plane : {-band, band}) {
      if ((from < plane) != (to < plane)) add(a + (plane - from) / (to - from) * (b - a));
    }
  }
  return points;
}

/// The polygon of a rank-2 section, counter-clockwise about the third axis, widened so that it has
/// area.
Points polygonAround(const Points& section, const Eigen::Vector3d& error) {
  const ConvexMesh hull = makeConvexMesh(section);
  if (!hull.faces.empty()) {
    const int face = hull.faces[0].normal.z() > 0.0 ? 0 : 1;
    Points polygon;
    for (int c = 0; c < hull.faces[face].count; ++c) {
      polygon.push_back(hull.vertices[hull.corners[hull.faces[face].first + c]]);
    }
    return polygon;
  }
  const double width = std::max(error.head<2>().norm(), 1e-300);
  const Eigen::Vector3d& a = hull.vertices.front();
  const Eigen::Vector3d& b = hull.vertices.back();
  const Eigen::Vector3d along =
      width * (a == b ? Eigen::Vector3d(Eigen::Vector3d::UnitX()) : (b - a).stableNormalized());
  const Eigen::Vector3d across(-along.y(), along.x(), 0.0);
  return {a - along - across, b + along - across, b + along + across, a - along + across};
}

void setToPrism(const Points& polygon, FaceSet& faces) {
  const int count = static_cast<int>(polygon.size());
  const Eigen::Vector3d up(0.0, 0.0, kPrismHalfWidth);
  faces.clear();
  for (const Eigen::Vector3d& p : polygon) faces.addVertex(p - up);
  for (const Eigen::Vector3d& p : polygon) faces.addVertex(p + up);
  faces.beginFace();
  for (int i = count - 1; i >= 0; --i) faces.addCorner(i);
  faces.beginFace();
  for (int i = 0; i < count; ++i) faces.addCorner(count + i);
  for (int i = 0; i < count; ++i) {
    const int next = (i + 1) % count;
    faces.addFace({i, next, count + next, count + i});
  }
}

void setToRod(const Points& section, double error, FaceSet& faces) {
  double lower = section.front().x();
  double upper = lower;
  for (const Eigen::Vector3d& p : section) {
    lower = std::min(lower, p.x());
    upper = std::max(upper, p.x());
  }
  const Eigen::Vector3d half(error, kPrismHalfWidth, kPrismHalfWidth);
  setToBox(Eigen::Vector3d(lower, 0.0, 0.0) - half, Eigen::Vector3d(upper, 0.0, 0.0) + half, faces);
}

}  // namespace

void replaceBySection(int rank, const Eigen::Vector3d& error, FaceSet& faces) {
  Points section = sectionPoints(edgesOf(faces), 2, error[2]);
  for (int k = 1; k >= rank; --k) section = sectionPoints(edgesOf(section), k, error[k]);
  faces.clear();
  if (section.empty()) return;
  if (rank == 2) {
    setToPrism(polygonAround(section, error), faces);
  } else if (rank == 1) {
    setToRod(section, error[0], faces);
  } else {
    setToBox(Eigen::Vector3d::Constant(-kPrismHalfWidth),
             Eigen::Vector3d::Constant(kPrismHalfWidth), faces);
  }
}

double prismMass(int rank) {
  return std::pow(normalIntervalMass(-kPrismHalfWidth, kPrismHalfWidth), 3 - rank);
}

double errorOfMoving(int rank, const Eigen::Vector3d& error) {
  double squared = error[0] * error[0];
  for (int k = 1; k < rank; ++k) squared += error[k] * error[k];
  return std::sqrt(squared);
}

}  // namespace fcl_prob::detail
