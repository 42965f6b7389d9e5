// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/mesh_visitor.h"

namespace fcl_prob::detail {

MeshView meshView(const fcl::CollisionGeometryd& geometry) {
  return visitMesh(geometry, [](const auto& model) { return viewOf(model); });
}

TriangleMesh triangleMesh(const MeshView& view) {
  return {{view.vertices, view.vertices + view.vertex_count},
          {view.triangles, view.triangles + view.triangle_count}};
}

}  // namespace fcl_prob::detail
