// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Meshes that are nearly convex, for tests.
#pragma once

#include <Eigen/Geometry>

#include "fcl_prob/triangle_mesh.h"
#include "random_bodies.h"

namespace fcl_prob_test {

/// Some triangles in three, with a point of their middle pushed inwards.
inline fcl_prob::TriangleMesh withDents(fcl_prob::TriangleMesh mesh, int count, double depth,
                                        RandomBodies& random) {
  for (int i = 0; i < count; ++i) {
    const auto at =
        static_cast<std::size_t>(random.integer(0, static_cast<int>(mesh.triangles.size()) - 1));
    const fcl::Triangle t = mesh.triangles[at];
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    const Eigen::Vector3d& b = mesh.vertices[t[1]];
    const Eigen::Vector3d& c = mesh.vertices[t[2]];
    const Eigen::Vector3d inwards = -(b - a).cross(c - a).normalized();
    const Eigen::Vector3d bottom = (a + b + c) / 3 + random.uniform(0.1, 1.0) * depth * inwards;
    const std::size_t middle = mesh.vertices.size();
    mesh.vertices.push_back(bottom);
    mesh.triangles[at] = {t[0], t[1], middle};
    mesh.triangles.emplace_back(t[1], t[2], middle);
    mesh.triangles.emplace_back(t[2], t[0], middle);
  }
  return mesh;
}

}  // namespace fcl_prob_test
