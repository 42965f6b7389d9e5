// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Small meshes by structure: shells, their nesting and orientation, rims, and what is degenerate.
#pragma once

#include "fcl_prob/triangle_mesh.h"
#include "random_bodies.h"

namespace fcl_prob_audit {

using fcl_prob::TriangleMesh;
using fcl_prob_test::RandomBodies;

/// The chances of what a mesh may have.
struct MeshStructure {
  int most_shells = 1;
  double nested = 0.2;       ///< of a further shell: inside the one before
  double far_shell = 0.2;    ///< of a further shell: many sizes away
  double inside_out = 0.2;   ///< of a shell
  double open = 0.0;         ///< a shell lacks triangles
  double stray_point = 0.0;  ///< triangles with three equal corners, anywhere
  double degenerate = 0.0;   ///< triangles that are segments, twice the same triangle, ...
  double stray_far = 0.3;    ///< of what strays: many sizes away
  double thin = 0.0;         ///< a shell is flattened along an axis
  double least_thinness = 1e-9;
  double flat = 0.0;    ///< ... to nothing
  double convex = 0.0;  ///< a shell is a hull, with many vertices at times
  double dented = 0.0;  ///< of such a shell: but for one vertex, by 1e-12 to 0.2
  double large = 0.0;   ///< a shell has 500 to 1,100 triangles
};

/// About 1 m wide around its origin (without what is far away), at most some dozens of triangles
/// where no shell is large. Coordinates are multiples of 2^-20 (of 2^-40 where shells may be
/// convex) but for thin ones. Shells are closed unless `open` says so.
TriangleMesh randomMesh(RandomBodies& random, const MeshStructure& structure);

/// The faces of the hull of some points.
TriangleMesh hullMesh(const std::vector<Eigen::Vector3d>& points);

/// To multiples of 2^-bits.
Eigen::Vector3d snapped(const Eigen::Vector3d& v, int bits = 20);

}  // namespace fcl_prob_audit
