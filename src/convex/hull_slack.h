// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "convex/convex_mesh.h"

namespace fcl_prob::detail {

/// A length that none of the points is farther away than from the hull of the mesh's vertices,
/// whatever made the mesh of them left out as being within it.
double hullSlack(const ConvexMesh& mesh, const std::vector<Eigen::Vector3d>& points);

}  // namespace fcl_prob::detail
