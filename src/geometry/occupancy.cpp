// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/occupancy.h"

#include <fcl/geometry/octree/octree.h>

#include "base/number_text.h"
#include "geometry/geometry_kind.h"
#include "geometry/mesh_visitor.h"

namespace fcl_prob::detail {
namespace {

bool isOcTree(const fcl::CollisionGeometryd& geometry) {
  return kindOf(geometry) == GeometryKind::octree;
}

/// Whether a traversal of the two starts at their leaves.
bool areSingleLeaves(const fcl::OcTreed& octree, const fcl::CollisionGeometryd& other) {
  const auto* root = octree.getRoot();
  const bool single_cell = root == nullptr || !octree.nodeHasChildren(root);
  return single_cell &&
         (kindOf(other) != GeometryKind::mesh || meshView(other).triangle_count == 1);
}

std::string nameOf(const fcl::CollisionGeometryd& geometry) {
  return nodeTypeName(geometry.getNodeType());
}

std::optional<std::string> whyNotOccupied(const fcl::CollisionGeometryd& geometry) {
  if (geometry.isOccupied()) return std::nullopt;
  return nameOf(geometry) + " is not occupied, its cost_density " +
         numberText(geometry.cost_density) + " is not at or above its threshold_occupied " +
         numberText(geometry.threshold_occupied) + ": fcl::collide leaves it out";
}

std::optional<std::string> whyNeverInOcTree(const fcl::OcTreed& octree,
                                            const fcl::CollisionGeometryd& other) {
  if (auto why = whyNotOccupied(other)) return why;
  if (!other.isFree() || areSingleLeaves(octree, other)) return std::nullopt;
  return nameOf(other) + " is free, its cost_density " + numberText(other.cost_density) +
         " is not above its threshold_free " + numberText(other.threshold_free) +
         ": fcl::collide with an octree leaves it out";
}

}  // namespace

std::optional<std::string> whyNeverInContact(const fcl::CollisionGeometryd& a,
                                             const fcl::CollisionGeometryd& b) {
  if (isOcTree(a) && isOcTree(b)) return std::nullopt;
  if (isOcTree(a)) return whyNeverInOcTree(static_cast<const fcl::OcTreed&>(a), b);
  if (isOcTree(b)) return whyNeverInOcTree(static_cast<const fcl::OcTreed&>(b), a);
  auto why = whyNotOccupied(a);
  return why ? why : whyNotOccupied(b);
}

bool isAlikeBesideOcTrees(const fcl::CollisionGeometryd& geometry) {
  return isOcTree(geometry) || !geometry.isOccupied() || !geometry.isFree();
}

}  // namespace fcl_prob::detail
