// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Any geometry as triangles that leave nothing of it out.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Core>

#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::detail {

/// What a geometry looks like from within a ball around `centre` (metres, frame of the geometry).
struct OuterMeshRequest {
  double tolerance;  ///< metres: how far a curved shape may be exceeded, if 256 segments allow it
  Eigen::Vector3d centre;  ///< only for unbounded shapes
  double reach;            ///< metres: only for unbounded shapes
};

/// Triangles (frame of the geometry) whose surface is that of a mesh, Box, Convex, TriangleP or
/// octree, and a polyhedron around a curved shape; a Halfspace becomes a box and a Plane a square
/// that are right within the reach. So the distance to the triangles is never more than that to the
/// geometry, for points outside. \throws UnsupportedGeometry
TriangleMesh outerMesh(const fcl::CollisionGeometryd& geometry, const OuterMeshRequest& request);

}  // namespace fcl_prob::detail
