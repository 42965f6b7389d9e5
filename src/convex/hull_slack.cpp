// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/hull_slack.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// Of the size of what is added up: more than a scalar product is rounded by.
constexpr double kProductRounding = 16.0 * kEpsilon;

bool isBefore(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// The points that are no vertices.
Points leftOut(const ConvexMesh& mesh, const Points& points) {
  const std::set<Eigen::Vector3d, decltype(&isBefore)> vertices(mesh.vertices.begin(),
                                                                mesh.vertices.end(), &isBefore);
  Points result;
  for (const Eigen::Vector3d& p : points) {
    if (vertices.count(p) == 0) result.push_back(p);
  }
  return result;
}

/// From a point to one of the segment, the nearest but for rounding.
double toSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double length = along.stableNorm();
  if (!(length > 0.0)) return (p - a).stableNorm();
  const Eigen::Vector3d unit = along / length;
  const double at = std::clamp(unit.dot(p - a), 0.0, length);
  return (p - a - at * unit).stableNorm();
}

/// The same for a triangle: where the point is beside it, and not above, the edges have the
/// nearest.
double toTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                  const Eigen::Vector3d& c) {
  const double to_edges = std::min({toSegment(p, a, b), toSegment(p, b, c), toSegment(p, c, a)});
  const Eigen::Vector3d n = (b - a).cross(c - a).stableNormalized();
  const auto isInside = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return n.dot((to - from).cross(p - from)) >= 0.0;
  };
  if (!isInside(a, b) || !isInside(b, c) || !isInside(c, a)) return to_edges;
  return std::min(to_edges, std::fabs(n.dot(p - a)));
}

/// To vertices in order around a polygon, or to fewer of them.
double toPolygon(const Eigen::Vector3d& p, const Points& corners) {
  double least = toSegment(p, corners.front(), corners.back());
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    least = std::min(least, toTriangle(p, corners[0], corners[i], corners[i + 1]));
  }
  return least;
}

double ofFlat(const ConvexMesh& mesh, const Points& points) {
  double farthest = 0.0;
  double reach = 0.0;
  for (const Eigen::Vector3d& p : points) {
    farthest = std::max(farthest, toPolygon(p, mesh.vertices));
    reach = std::max(reach, (p - mesh.vertices.front()).stableNorm());
  }
  return farthest + kProductRounding * reach;
}

double lowestCorner(const ConvexMesh& mesh, const ConvexMesh::Face& face,
                    const Eigen::Vector3d& centre) {
  double lowest = kInfinity;
  for (int c = 0; c < face.count; ++c) {
    const Eigen::Vector3d& corner = mesh.vertices[mesh.corners[face.first + c]];
    lowest = std::min(lowest, face.normal.dot(corner - centre));
  }
  return lowest;
}

/// What is below all planes through the lowest corners of the faces is within the hull: between it
/// and the centre there is no surface. A point that is by s above one comes below all of them by
/// being moved towards the centre, which is by d below, by the share s / (d + s) of the way.
double ofSolid(const ConvexMesh& mesh, const Points& points) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& v : mesh.vertices) {
    centre += v / static_cast<double>(mesh.vertices.size());
  }
  double reach = 0.0;
  double magnitude = centre.stableNorm();
  for (const Eigen::Vector3d& p : points) {
    reach = std::max(reach, (p - centre).stableNorm());
    magnitude = std::max(magnitude, p.stableNorm());
  }
  const double rounding = kProductRounding * (reach + kEpsilon * magnitude);
  double depth = kInfinity;
  double above = 0.0;
  for (const ConvexMesh::Face& face : mesh.faces) {
    const double plane = lowestCorner(mesh, face, centre);
    depth = std::min(depth, plane);
    for (const Eigen::Vector3d& p : points) {
      above = std::max(above, face.normal.dot(p - centre) - plane);
    }
  }
  above += rounding;
  depth -= rounding;
  return depth > 0.0 ? reach * (above / (depth + above)) : reach;
}

}  // namespace

double hullSlack(const ConvexMesh& mesh, const Points& points) {
  const Points left_out = leftOut(mesh, points);
  if (left_out.empty()) return 0.0;
  const bool is_flat = mesh.faces.size() < 3;
  const double slack = is_flat ? ofFlat(mesh, left_out) : ofSolid(mesh, left_out);
  return slack * (1.0 + kProductRounding);
}

}  // namespace fcl_prob::detail
