// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/mesh_visitor.h"

namespace fcl_prob::detail {

MeshView meshView(const fcl::CollisionGeometryd& geometry) {
  return visitMesh(geometry, [](const auto& model) {
    MeshView view;
    view.vertices = model.vertices;
    view.vertex_count = model.num_vertices;
    view.triangles = model.tri_indices;
    view.triangle_count = model.num_tris;
    view.build_state = model.build_state;
    view.node_count = model.getNumBVs();
    return view;
  });
}

TriangleMesh triangleMesh(const MeshView& view) {
  return {{view.vertices, view.vertices + view.vertex_count},
          {view.triangles, view.triangles + view.triangle_count}};
}

}  // namespace fcl_prob::detail
