// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "paper/geometry_tree.h"

#include "fcl_prob/exceptions.h"
#include "geometry/geometry_kind.h"
#include "geometry/mesh_visitor.h"
#include "geometry/validation.h"

namespace fcl_prob::detail {
namespace {

template <typename BV>
std::unique_ptr<const BoundingTree> modelTree(const fcl::BVHModel<BV>& model) {
  return std::make_unique<const ModelTree<BV>>(model);
}

}  // namespace

void requireTree(const fcl::CollisionGeometryd& geometry, const std::string& name,
                 const std::string& method) {
  validateGeometry(&geometry, name);
  const GeometryKind kind = kindOf(geometry);
  if (kind == GeometryKind::mesh || kind == GeometryKind::convex) return;
  throw UnsupportedGeometry(name + ": " + method +
                            " needs a mesh or a bounded convex shape, not a " +
                            nodeTypeName(geometry.getNodeType()));
}

std::unique_ptr<const BoundingTree> makeTree(const fcl::CollisionGeometryd& geometry) {
  if (kindOf(geometry) != GeometryKind::mesh) return std::make_unique<const ShapeTree>(geometry);
  return visitMesh(geometry, [](const auto& model) { return modelTree(model); });
}

}  // namespace fcl_prob::detail
