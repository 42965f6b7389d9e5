// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "decomposition/padded_hull.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fcl_prob/exceptions.h"

namespace fcl_prob::detail {
namespace {

/// Scaling by more would be seen.
constexpr double kMostScaling = 1e-6;

/// Of the padding, against the rounding of the hull and of the scaling.
constexpr double kReserve = 2.0;

Eigen::Vector3d middleOf(const ConvexPolytope& hull) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& v : hull.vertices) sum += v;
  return sum / static_cast<double>(hull.vertices.size());
}

double inradiusAbout(const Eigen::Vector3d& middle, const ConvexPolytope& hull) {
  double least = std::numeric_limits<double>::infinity();
  for (const ConvexPolytope::Face& face : hull.faces) {
    least = std::min(least, face.offset - face.normal.dot(middle));
  }
  return hull.faces.empty() ? 0.0 : least;
}

void setOffsets(ConvexPolytope& hull) {
  for (ConvexPolytope::Face& face : hull.faces) {
    face.offset = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& v : hull.vertices) {
      face.offset = std::max(face.offset, face.normal.dot(v));
    }
  }
}

/// An octahedron contains a ball of its size over the square root of three.
ConvexPolytope hullOfOctahedra(const std::vector<Eigen::Vector3d>& points, double size) {
  std::vector<Eigen::Vector3d> corners;
  for (const Eigen::Vector3d& point : points) {
    for (int k = 0; k < 3; ++k) {
      for (const double sign : {-1.0, 1.0}) {
        corners.push_back(point + sign * size * Eigen::Vector3d::Unit(k));
      }
    }
  }
  return convexHull(corners);
}

}  // namespace

ConvexPolytope paddedHull(ConvexPolytope hull, double padding) {
  const Eigen::Vector3d middle = middleOf(hull);
  const double inradius = inradiusAbout(middle, hull);
  if (inradius * kMostScaling > kReserve * padding) {
    const double scale = 1.0 + kReserve * padding / inradius;
    for (Eigen::Vector3d& v : hull.vertices) v = middle + scale * (v - middle);
    setOffsets(hull);
    return hull;
  }
  ConvexPolytope thick = hullOfOctahedra(hull.vertices, kReserve * std::sqrt(3.0) * padding);
  if (thick.faces.empty()) throw InvalidGeometry("a part of a mesh has a hull without faces");
  return thick;
}

}  // namespace fcl_prob::detail
