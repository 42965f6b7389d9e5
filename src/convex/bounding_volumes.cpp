// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/bounding_volumes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "convex/thinned_points.h"

namespace fcl_prob::detail {
namespace {

/// Of the largest coordinate: by how much the slabs of a k-DOP are widened.
constexpr double kDopPadding = 1e-14;

/// Many planes of a k-DOP around a polytope go through one vertex, up to rounding. Corners nearer
/// to each other than this, of the largest coordinate or of the extent, count as one.
constexpr double kDopThinning = 10.0 * kDopPadding;
constexpr double kDopThinningOfExtent = 1e-10;

}  // namespace

RoundedZonotope roundedZonotope(const fcl::AABBd& box) {
  RoundedZonotope result{Zonotope(0.5 * (box.min_ + box.max_)), 0.0};
  const Eigen::Vector3d half = 0.5 * (box.max_ - box.min_);
  for (int k = 0; k < 3; ++k) result.core.addGenerator(half[k] * Eigen::Vector3d::Unit(k));
  return result;
}

RoundedZonotope roundedZonotope(const fcl::OBBd& box) {
  RoundedZonotope result{Zonotope(box.To), 0.0};
  for (int k = 0; k < 3; ++k) result.core.addGenerator(box.extent[k] * box.axis.col(k));
  return result;
}

RoundedZonotope roundedZonotope(const fcl::RSSd& rss) {
  const Eigen::Vector3d u = 0.5 * rss.l[0] * rss.axis.col(0);
  const Eigen::Vector3d v = 0.5 * rss.l[1] * rss.axis.col(1);
  RoundedZonotope result{Zonotope(rss.To + u + v), rss.r};
  result.core.addGenerator(u);
  result.core.addGenerator(v);
  return result;
}

RoundedZonotope roundedZonotope(const SphereBv& sphere) {
  return {Zonotope(sphere.center()), sphere.radius()};
}

RoundedZonotope roundedZonotope(const fcl::OBBRSSd& both) { return roundedZonotope(both.obb); }

RoundedZonotope roundedZonotope(const fcl::kIOSd& kios) { return roundedZonotope(kios.obb); }

RoundedZonotope smallestSphere(const fcl::kIOSd& kios) {
  unsigned best = 0;
  for (unsigned i = 1; i < kios.num_spheres; ++i) {
    if (kios.spheres[i].r < kios.spheres[best].r) best = i;
  }
  return {Zonotope(kios.spheres[best].o), kios.spheres[best].r};
}

void setToSlabsOf(const Kdop26& dop, std::vector<Slab>& slabs) {
  slabs.clear();
  for (int k = 0; k < Kdop26::kSlabs; ++k) {
    slabs.push_back({Kdop26::direction(k), dop.lower(k), dop.upper(k)});
  }
}

void addReversed(const std::vector<Slab>& slabs_of_a, std::vector<Slab>& slabs_of_b) {
  for (std::size_t k = 0; k < slabs_of_b.size(); ++k) {
    slabs_of_b[k].lower -= slabs_of_a[k].upper;
    slabs_of_b[k].upper -= slabs_of_a[k].lower;
  }
}

ConvexMesh meshOfSlabs(const std::vector<Slab>& slabs) {
  double size = 0.0;
  for (int k = 0; k < 3; ++k) {
    size = std::max({size, std::abs(slabs[k].lower), std::abs(slabs[k].upper)});
  }
  FaceSet faces;
  setToSlabs(slabs, kDopPadding * size, faces);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : faces.vertices()) box.extend(v);
  const double distance =
      std::max(kDopThinning * size, kDopThinningOfExtent * box.sizes().maxCoeff());
  ConvexMesh mesh = makeConvexMesh(thinnedOut(faces.vertices(), distance));
  mesh.slack += distance;
  return mesh;
}

}  // namespace fcl_prob::detail
