// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "paper/bv_volumes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace fcl_prob::detail {
namespace {

double ballVolume(double radius) { return 4.0 / 3.0 * M_PI * radius * radius * radius; }

}  // namespace

double volumeOf(const ConvexMesh& mesh) {
  const Eigen::Vector3d& origin = mesh.vertices.front();
  double volume = 0.0;
  for (const ConvexMesh::Face& face : mesh.faces) {
    const auto corner = [&](int c) -> Eigen::Vector3d {
      return mesh.vertices[mesh.corners[face.first + c]] - origin;
    };
    for (int c = 1; c + 1 < face.count; ++c) {
      volume += corner(0).dot(corner(c).cross(corner(c + 1))) / 6.0;
    }
  }
  return std::max(volume, 0.0);
}

double volumeOf(const fcl::AABBd& box) { return (box.max_ - box.min_).prod(); }

double volumeOf(const fcl::OBBd& box) { return 8.0 * box.extent.prod(); }

double volumeOf(const fcl::RSSd& rss) {
  return 2.0 * rss.r * rss.l[0] * rss.l[1] + M_PI * rss.r * rss.r * (rss.l[0] + rss.l[1]) +
         ballVolume(rss.r);
}

double volumeOf(const fcl::OBBRSSd& both) { return volumeOf(both.obb); }

double volumeOf(const fcl::kIOSd& kios) {
  double least = volumeOf(kios.obb);
  for (unsigned i = 0; i < kios.num_spheres; ++i) {
    least = std::min(least, ballVolume(kios.spheres[i].r));
  }
  return least;
}

double volumeOf(const SphereBv& sphere) { return ballVolume(sphere.radius()); }

double volumeOfSlabs(const std::vector<Slab>& slabs) { return volumeOf(meshOfSlabs(slabs)); }

}  // namespace fcl_prob::detail
