// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Refusing bad geometries and poses before any work is done on them.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <string>

#include "geometry/mesh_visitor.h"

namespace fcl_prob::detail {

/// Checks that `geometry` is one that a query can work on, in time linear in its size.
/// \param name  how the message calls it, e.g. "object A"
/// \throws InvalidGeometry if it is null, unfinished, empty, a point cloud, has a coordinate that
/// is not
///         finite, an index out of range, a size that is not positive, or (Convex) faces that do
///         not close a convex body; the message holds the offending value.
/// \throws UnsupportedGeometry if its type is not one of FCL's.
void validateGeometry(const fcl::CollisionGeometryd* geometry, const std::string& name);

/// The part of validateGeometry() for meshes, also those of a bounding volume that FCL does not
/// know. \throws InvalidGeometry
void validateMeshView(const MeshView& mesh, const std::string& name);

/// Lengths are compared by their squares and products, which are no numbers where both objects are
/// smaller than this, in metres. (One of them may be, and deviations are divided by.)
inline constexpr double kLeastSize = 1e-140;

/// \param size_a, size_b  largest coordinates of the two objects, in metres, each from within it
/// \throws InvalidGeometry if both are below kLeastSize and one of them is not 0
void requireMeasurable(double size_a, double size_b);

/// \throws InvalidPose if `pose` is not finite, or its linear part not a rotation to 1e-9.
void validatePose(const fcl::Transform3d& pose, const std::string& name);

}  // namespace fcl_prob::detail
