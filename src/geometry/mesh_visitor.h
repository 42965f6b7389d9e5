// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// From a CollisionGeometry to the BVHModel<BV> that it is.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>

#include <utility>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/triangle_mesh.h"
#include "geometry/geometry_kind.h"

namespace fcl_prob::detail {

/// Calls `function` with the concrete `const fcl::BVHModel<BV>&` and returns what it returns (the
/// same type for every BV). \throws UnsupportedGeometry if `geometry` is not a mesh.
template <typename Function>
auto visitMesh(const fcl::CollisionGeometryd& geometry, Function&& function)
    -> decltype(function(std::declval<const fcl::BVHModel<fcl::OBBRSSd>&>())) {
  const auto as = [&geometry](auto* type) -> decltype(*type) {
    return static_cast<decltype(*type)>(geometry);
  };
  switch (geometry.getNodeType()) {
    case fcl::BV_AABB:
      return function(as(static_cast<const fcl::BVHModel<fcl::AABBd>*>(nullptr)));
    case fcl::BV_OBB:
      return function(as(static_cast<const fcl::BVHModel<fcl::OBBd>*>(nullptr)));
    case fcl::BV_RSS:
      return function(as(static_cast<const fcl::BVHModel<fcl::RSSd>*>(nullptr)));
    case fcl::BV_kIOS:
      return function(as(static_cast<const fcl::BVHModel<fcl::kIOSd>*>(nullptr)));
    case fcl::BV_OBBRSS:
      return function(as(static_cast<const fcl::BVHModel<fcl::OBBRSSd>*>(nullptr)));
    case fcl::BV_KDOP16:
      return function(as(static_cast<const fcl::BVHModel<fcl::KDOPd<16>>*>(nullptr)));
    case fcl::BV_KDOP18:
      return function(as(static_cast<const fcl::BVHModel<fcl::KDOPd<18>>*>(nullptr)));
    case fcl::BV_KDOP24:
      return function(as(static_cast<const fcl::BVHModel<fcl::KDOPd<24>>*>(nullptr)));
    default:
      throw UnsupportedGeometry("not a mesh: " + nodeTypeName(geometry.getNodeType()));
  }
}

/// The triangles of a mesh, whatever its bounding volumes: pointers into the model, which must
/// outlive it.
struct MeshView {
  const fcl::Vector3d* vertices = nullptr;  ///< metres, frame of the geometry
  int vertex_count = 0;
  const fcl::Triangle* triangles = nullptr;  ///< null in a point cloud
  int triangle_count = 0;
  fcl::BVHBuildState build_state = fcl::BVH_BUILD_STATE_EMPTY;
  int node_count = 0;  ///< of the bounding volume tree

  const fcl::Vector3d& vertex(int triangle, int corner) const {
    return vertices[triangles[triangle][corner]];
  }
};

/// Of a model of any bounding volume, also of those that visitMesh() does not know.
template <typename BV>
MeshView viewOf(const fcl::BVHModel<BV>& model) {
  MeshView view;
  view.vertices = model.vertices;
  view.vertex_count = model.num_vertices;
  view.triangles = model.tri_indices;
  view.triangle_count = model.num_tris;
  view.build_state = model.build_state;
  view.node_count = model.getNumBVs();
  return view;
}

/// Of triangles without a model.
inline MeshView viewOf(const TriangleMesh& mesh) {
  MeshView view;
  view.vertices = mesh.vertices.data();
  view.vertex_count = static_cast<int>(mesh.vertices.size());
  view.triangles = mesh.triangles.data();
  view.triangle_count = static_cast<int>(mesh.triangles.size());
  return view;
}

/// \throws UnsupportedGeometry if `geometry` is not a mesh.
MeshView meshView(const fcl::CollisionGeometryd& geometry);

/// A copy of the triangles.
TriangleMesh triangleMesh(const MeshView& view);

}  // namespace fcl_prob::detail
