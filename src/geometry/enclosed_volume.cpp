// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/enclosed_volume.h"

#include <Eigen/Geometry>

namespace fcl_prob::detail {
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

}  // namespace fcl_prob::detail
