// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/volumes.h"

#include <Eigen/Geometry>

#include "traversal/hull_tree.h"

namespace fcl_prob::cli {
namespace {

/// Six times the volume of the tetrahedron between a triangle and the origin.
double sixfoldVolume(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return a.dot(b.cross(c));
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
  return detail::volumeOf(detail::makeConvexMesh(mesh.vertices));
}

std::vector<double> volumesByLevel(const ConvexHullTree& tree, int levels) {
  return volumesByLevel(
      levels, [&tree](int node) { return tree.volume(node); },
      [&tree](int node) { return tree.tree().leftChild(node); });
}

}  // namespace fcl_prob::cli
