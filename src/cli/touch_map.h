// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where A is touched, if it is.
#pragma once

#include <cstdint>
#include <vector>

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::cli {

/// How likely each part of a mesh is to be the one that touches.
struct TouchMap {
  /// A value for each vertex of A, 0 to 1: how often the triangles around it touch B, for their
  /// area, relative to the most touched vertex.
  std::vector<double> likelihood;
  std::size_t samples = 0;
  std::size_t hits = 0;
};

/// Samples displacements of A and counts the triangles that meet B; every colliding sample counts
/// one, shared among its triangles. Both meshes are in the world frame.
TouchMap touchMap(const TriangleMesh& a, const TriangleMesh& b,
                  const GaussianDisplacement& displacement, std::size_t samples,
                  std::uint64_t seed);

}  // namespace fcl_prob::cli
