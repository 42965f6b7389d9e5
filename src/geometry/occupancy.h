// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What fcl::collide leaves out whatever the poses: geometries that are not occupied.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <optional>
#include <string>

namespace fcl_prob::detail {

/// Why fcl::collide finds no contact of the two at any poses; nothing if it may find some.
///
/// FCL 0.7 (narrowphase/detail/traversal) asks `isOccupied()`, cost_density >= threshold_occupied,
/// of both geometries before it compares two shapes, two triangles, or one of each. Of an octree it
/// asks that of the cells and never of the geometry; a mesh or shape that meets one must be
/// occupied and, unless there is nothing to descend into, not also be `isFree()`, cost_density <=
/// threshold_free.
std::optional<std::string> whyNeverInContact(const fcl::CollisionGeometryd& a,
                                             const fcl::CollisionGeometryd& b);

/// Whether FCL asks of the geometry, beside an octree, what it asks of it beside anything else.
bool isAlikeBesideOcTrees(const fcl::CollisionGeometryd& geometry);

/// For another geometry that stands for the same object.
inline void copyOccupancy(const fcl::CollisionGeometryd& from, fcl::CollisionGeometryd& to) {
  to.cost_density = from.cost_density;
  to.threshold_occupied = from.threshold_occupied;
  to.threshold_free = from.threshold_free;
}

}  // namespace fcl_prob::detail
