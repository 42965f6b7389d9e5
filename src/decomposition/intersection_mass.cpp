// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "decomposition/intersection_mass.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "convex/cut_polytope.h"
#include "convex/thinned_points.h"
#include "decomposition/point_sets.h"
#include "fcl_prob/convex_polytope.h"
#include "fcl_prob/polytope_mass.h"

namespace fcl_prob::detail {
namespace {

/// Of a sum of three products and its comparison, relative to the lengths that are multiplied.
constexpr double kHeightRounding = 16.0 * std::numeric_limits<double>::epsilon();

/// A factor that makes up for the rounding of the multiplication by itself.
constexpr double kBelowOne = 1.0 - 16.0 * std::numeric_limits<double>::epsilon();

/// Of a body's length: by how much planes are moved until the cuts give a closed surface. They may
/// fail to where many planes meet in a point up to rounding.
constexpr double kLoosenings[] = {0.0, 1e-10, 1e-8, 1e-6};

/// Of a body's length: points nearer to each other count as one.
constexpr double kThinning = 1e-10;

/// Multiples of the one modulo the other are scattered.
constexpr std::size_t kScatter = 619;
constexpr std::size_t kScatterModulus = 1024;

double lengthOf(const FaceSet& faces) {
  double longest = 0.0;
  for (const Eigen::Vector3d& v : faces.vertices()) longest = std::max(longest, v.stableNorm());
  return longest;
}

double highest(const FaceSet& faces, const Eigen::Vector3d& normal) {
  double height = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& v : faces.vertices()) height = std::max(height, normal.dot(v));
  return height;
}

/// How much a body, seen from `centre`, may be scaled without leaving the obstacle; 0 if the centre
/// is not safely inside.
double scaleInto(const KnownObstacle& obstacle, const FaceSet& body,
                 const Eigen::Vector3d& centre) {
  const double rounding = kHeightRounding * (lengthOf(body) + centre.stableNorm());
  double scale = 1.0;
  for (std::size_t f = 0; f < obstacle.normals().size(); ++f) {
    const Eigen::Vector3d& normal = obstacle.normals()[f];
    const double room = obstacle.inner()[f] - normal.dot(centre) - rounding;
    if (!(room > 0.0)) return 0.0;
    const double reach = highest(body, normal) - normal.dot(centre) + rounding;
    if (reach > room) scale = std::min(scale, kBelowOne * (room / reach));
  }
  return scale;
}

/// Cuts leave narrow faces that are uneven; those of a hull are even, and merged where they can be.
/// Points may be off by `error`.
Bounds massOfHull(const FaceSet& faces, double error) {
  const double distance = kThinning * lengthOf(faces);
  const ConvexPolytope hull = convexHull(thinnedOut(faces.vertices(), distance));
  if (hull.faces.empty()) return {0.0, 1.0};
  const Bounds inside = polytopeMass(hull);
  return {inside.lower, polytopeMass(hull, error + 2.0 * distance).upper};
}

/// The mass of the same body a little smaller, every corner of which is in both obstacles.
double massInside(const KnownObstacle& a, const KnownObstacle& b, FaceSet common) {
  const Eigen::Vector3d centre = middleOf(common.vertices());
  const double scale = std::min(scaleInto(a, common, centre), scaleInto(b, common, centre));
  if (!(scale > 0.0)) return 0.0;
  for (Eigen::Vector3d& v : common.vertices()) v = centre + scale * (v - centre);
  return std::max(0.0, massOfHull(common, 0.0).lower);
}

/// The part of `body` that is in `obstacle`, moved outwards by `margin` and a different part of
/// `loosening` for every plane.
FaceSet cutBy(const KnownObstacle& obstacle, const KnownObstacle& body, double margin,
              double loosening) {
  CutPolytope cut(body.faces());
  for (std::size_t f = 0; f < obstacle.normals().size(); ++f) {
    const double part = static_cast<double>(f * kScatter % kScatterModulus) / kScatterModulus;
    cut.cut(obstacle.normals()[f], obstacle.outer()[f] + margin + part * loosening);
  }
  FaceSet common;
  cut.writeTo(common);
  return common;
}

}  // namespace

KnownObstacle::KnownObstacle(FaceSet faces, double error)
    : faces_(std::move(faces)), error_(error) {
  const double distance = kThinning * lengthOf(faces_);
  const ConvexPolytope hull = convexHull(thinnedOut(faces_.vertices(), distance));
  FaceSet even = toFaceSet(hull);
  // The normals of narrow faces are noise, and what is surely below their planes is little.
  if (even.faceCount() > 0 && even.closed()) {
    faces_ = std::move(even);
    error_ += distance;
  }
  setPlanes(error);
}

void KnownObstacle::setPlanes(double inner_error) {
  const double rounding = kHeightRounding * lengthOf(faces_);
  for (std::size_t f = 0; f < faces_.faceCount(); ++f) {
    const Eigen::Vector3d area = faces_.vectorArea(f);
    if (!(area.stableNorm() > 0.0)) continue;
    const Eigen::Vector3d normal = area.stableNormalized();
    double lowest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < faces_.cornerCount(f); ++i) {
      lowest = std::min(lowest, normal.dot(faces_.position(f, i)));
    }
    normals_.push_back(normal);
    inner_.push_back(lowest - (inner_error + rounding));
    outer_.push_back(highest(faces_, normal) + (error_ + rounding));
  }
}

bool KnownObstacle::contains(const Eigen::Vector3d& point) const {
  for (std::size_t f = 0; f < normals_.size(); ++f) {
    if (normals_[f].dot(point) > outer_[f]) return false;
  }
  return true;
}

Bounds intersectionMass(const KnownObstacle& a, const KnownObstacle& b) {
  for (const double loosening : kLoosenings) {
    for (const auto& [body, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
      const double error = body->error() + kHeightRounding * lengthOf(body->faces());
      FaceSet common = cutBy(*other, *body, 2.0 * error, loosening * lengthOf(body->faces()));
      if (common.faceCount() < 4) return {0.0, 0.0};
      if (!common.closed()) continue;
      const Bounds mass = massOfHull(common, error);
      return {massInside(a, b, std::move(common)), std::clamp(mass.upper, 0.0, 1.0)};
    }
  }
  return {0.0, 1.0};
}

}  // namespace fcl_prob::detail
