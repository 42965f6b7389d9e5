// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex shapes that are polytopes, as their vertices.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace fcl_prob::detail {

/// The vertices (metres, frame of the geometry) of a Box, Convex or TriangleP, whose convex hull
/// the shape is; nothing for a shape with curved sides, an unbounded one or a mesh.
std::optional<std::vector<Eigen::Vector3d>> polytopeVertices(
    const fcl::CollisionGeometryd& geometry);

}  // namespace fcl_prob::detail
