// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/support_slabs.h"

#include <Eigen/Cholesky>

#include "convex/slab_polytope.h"

namespace fcl_prob::detail {

namespace {

// The directions of a 26-DOP in the frame in which the obstacle is about as wide in every
// direction, and the normals of flat sides.
std::vector<Eigen::Vector3d> slabNormals(const SupportObstacle& obstacle) {
  std::vector<Eigen::Vector3d> normals = obstacle.sideNormals();
  const Eigen::Matrix3d spread = obstacle.spread();
  const double floor = 1e-12 * spread.trace();
  const Eigen::LLT<Eigen::Matrix3d> factor(spread + floor * Eigen::Matrix3d::Identity());
  for (const Eigen::Vector3d& direction : dopDirections()) {
    const Eigen::Vector3d normal = factor.matrixU().solve(direction);
    normals.push_back(normal.stableNormalized());
  }
  return normals;
}

}  // namespace

PieceSlabs supportSlabs(const SupportObstacle& obstacle) {
  const std::vector<Eigen::Vector3d> normals = slabNormals(obstacle);
  const int used = static_cast<int>(normals.size());
  PieceSlabs slabs;
  slabs.count = (used + 3) / 4 * 4;
  slabs.data.assign(static_cast<std::size_t>(slabs.count) * kSlabFields, 0.0);
  double* out = slabs.data.data();
  for (int i = 0; i < slabs.count; ++i) {
    const bool known = i < used && normals[i].allFinite();
    if (known) {
      for (int k = 0; k < 3; ++k) out[k * slabs.count + i] = normals[i][k];
    }
    out[3 * slabs.count + i] = known ? -obstacle.supportUpper(-normals[i]) : -kUnbounded;
    out[4 * slabs.count + i] = known ? obstacle.supportUpper(normals[i]) : kUnbounded;
  }
  out[5 * slabs.count] = 4 * kUnbounded;
  return slabs;
}

}  // namespace fcl_prob::detail
