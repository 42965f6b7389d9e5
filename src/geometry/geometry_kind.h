// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What sort of set an FCL geometry describes.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <string>

namespace fcl_prob::detail {

enum class GeometryKind {
  mesh,        ///< BVHModel of any bounding volume: a surface of triangles
  convex,      ///< Box, Sphere, Ellipsoid, Capsule, Cone, Cylinder, Convex, TriangleP: bounded and
               ///< solid
  unbounded,   ///< Halfspace, Plane
  octree,      ///< OcTree: the union of its occupied cells
  unsupported  ///< a type of the user's own
};

GeometryKind kindOf(const fcl::CollisionGeometryd& geometry);

/// The class name of an FCL node type as it is written in C++, for messages: "BVHModel<OBBRSS>",
/// "Box".
std::string nodeTypeName(fcl::NODE_TYPE type);

}  // namespace fcl_prob::detail
