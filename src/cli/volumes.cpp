// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/volumes.h"

#include <Eigen/Geometry>
#include <boost/math/constants/constants.hpp>

#include "traversal/hull_tree.h"

namespace fcl_prob::cli {
namespace {

constexpr double kPi = boost::math::constants::pi<double>();

double ballVolume(double radius) { return 4.0 / 3.0 * kPi * radius * radius * radius; }

/// Six times the volume of the tetrahedron between a triangle and the origin.
double sixfoldVolume(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return a.dot(b.cross(c));
}

double volumeOfMesh(const detail::ConvexMesh& mesh) {
  double sum = 0.0;
  for (const detail::ConvexMesh::Face& face : mesh.faces) {
    const auto corner = [&](int i) { return mesh.vertices[mesh.corners[face.first + i]]; };
    for (int i = 2; i < face.count; ++i) sum += sixfoldVolume(corner(0), corner(i - 1), corner(i));
  }
  return sum / 6.0;
}

}  // namespace

double enclosedVolume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const fcl::Triangle& t : mesh.triangles) {
    sum += sixfoldVolume(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
  }
  return sum / 6.0;
}

double hullVolume(const TriangleMesh& mesh) {
  return volumeOfMesh(detail::makeConvexMesh(mesh.vertices));
}

double volumeOf(const fcl::AABBd& box) { return (box.max_ - box.min_).prod(); }

double volumeOf(const fcl::OBBd& box) { return 8.0 * box.extent.prod(); }

double volumeOf(const fcl::RSSd& rss) {
  return 2.0 * rss.r * rss.l[0] * rss.l[1] + kPi * rss.r * rss.r * (rss.l[0] + rss.l[1]) +
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

double volumeOfSlabs(const std::vector<detail::Slab>& slabs) {
  return volumeOfMesh(detail::meshOfSlabs(slabs));
}

std::vector<double> volumesByLevel(const ConvexHullTree& tree, int levels) {
  return volumesByLevel(
      levels, [&tree](int node) { return tree.volume(node); },
      [&tree](int node) { return tree.tree().leftChild(node); });
}

}  // namespace fcl_prob::cli
