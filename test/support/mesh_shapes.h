// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Small triangle meshes for tests, and models of any bounding volume made of them.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>

#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob_test {

/// Triangles of the shapes here are counter-clockwise seen from outside.
using fcl_prob::TriangleMesh;

/// An axis-aligned box centred at the origin: 8 vertices, 12 triangles.
TriangleMesh boxMesh(const Eigen::Vector3d& sides);

/// A sphere around the origin by latitude and longitude; every vertex is on the sphere.
TriangleMesh sphereMesh(double radius, int rings, int segments);

/// A torus around the z axis.
TriangleMesh torusMesh(double radius, double tube_radius, int segments, int tube_segments);

/// A bumpy closed ball: a sphere whose radius varies by +-30 %, reproducible by `seed`. Not convex.
TriangleMesh bumpyMesh(double radius, int rings, int segments, std::uint64_t seed);

/// The convex hull of points: every face a fan of triangles.
TriangleMesh hullMesh(const std::vector<Eigen::Vector3d>& points);

/// Both meshes in one.
TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b);

/// The mesh with every vertex transformed.
TriangleMesh transformed(TriangleMesh mesh, const Eigen::Isometry3d& pose);

/// The mesh with its triangles turned inside out.
TriangleMesh reversed(TriangleMesh mesh);

/// A finished FCL model of the mesh.
template <typename BV>
std::shared_ptr<fcl::BVHModel<BV>> makeModel(const TriangleMesh& mesh) {
  return fcl_prob::buildModel<BV>(mesh);
}

}  // namespace fcl_prob_test
