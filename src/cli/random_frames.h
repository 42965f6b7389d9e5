// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Random rotations and displacements that a seed and an index determine.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "fcl_prob/triangle_mesh.h"
#include "fcl_prob/whitening.h"

namespace fcl_prob::cli {

/// Rotation number `index` of a seed, uniform on SO(3).
Eigen::Matrix3d randomRotation(std::uint64_t seed, std::uint64_t index);

/// Displacement number `index` of a seed, metres, world frame.
Eigen::Vector3d randomDisplacement(const Whitening& whitening, std::uint64_t seed,
                                   std::uint64_t index);

/// The mesh with its vertices rotated about the origin.
TriangleMesh rotated(TriangleMesh mesh, const Eigen::Matrix3d& rotation);

}  // namespace fcl_prob::cli
