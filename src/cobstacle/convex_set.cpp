// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cobstacle/convex_set.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/length.h"

namespace fcl_prob::detail {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// The outer polytope is this much larger than computed, so that rounding leaves no point outside.
constexpr double kOuterSlack = 1e-12;

Points pointsOnCircle(int count) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * M_PI * i / count;
    points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  return points;
}

/// Fibonacci lattice with its mirror image: nearly even, and symmetric about the centre.
Points pointsOnSphere(int count) {
  const double golden_angle = M_PI * (3.0 - std::sqrt(5.0));
  const int half = std::max(count / 2, 3);
  Points points;
  for (int i = 0; i < half; ++i) {
    const double height = (i + 0.5) / half;
    const double radius = std::sqrt(1.0 - height * height);
    const Eigen::Vector3d p(radius * std::cos(i * golden_angle),
                            radius * std::sin(i * golden_angle), height);
    points.push_back(p);
    points.push_back(-p);
  }
  return points;
}

/// Radius of the largest ball (disk) around the origin inside the hull of the points.
double inradius(const Points& points, bool disk) {
  if (disk) return std::cos(M_PI / static_cast<double>(points.size()));
  double least = std::numeric_limits<double>::infinity();
  const ConvexPolytope hull = convexHull(points);
  for (const ConvexPolytope::Face& face : hull.faces) {
    for (int vertex : face.vertices) {
      least = std::min(least, face.normal.dot(hull.vertices[vertex]));
    }
  }
  return least;
}

}  // namespace

double ConvexSet::size() const {
  double largest = 0.0;
  for (const Eigen::Vector3d& v : outerMesh().vertices) largest = std::max(largest, lengthOf(v));
  return largest;
}

SweptSet::SweptSet(SupportShape shape, int resolution) : shape_(std::move(shape)) {
  const bool disk = shape_.semi_axes.col(2).isZero(0.0);
  const Points ball = disk ? pointsOnCircle(resolution) : pointsOnSphere(resolution);
  outer_ = hullOf(ball, (1.0 + kOuterSlack) / inradius(ball, disk));
  inner_ = hullOf(ball, 1.0);
}

ConvexMesh SweptSet::hullOf(const Points& ball, double scale) const {
  Points points(shape_.points.begin() + shape_.swept, shape_.points.end());
  for (int i = 0; i < shape_.swept; ++i) {
    for (const Eigen::Vector3d& p : ball) {
      points.push_back(shape_.points[i] + shape_.semi_axes * (scale * p));
    }
  }
  return makeConvexMesh(points);
}

}  // namespace fcl_prob::detail
