// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>

#include "catch.h"
#include "geometry/convex_vertices.h"
#include "geometry/mesh_visitor.h"
#include "mesh_shapes.h"

using namespace fcl_prob::detail;
using namespace fcl_prob_test;

TEMPLATE_TEST_CASE("every kind of mesh is visited as what it is", "", fcl::AABBd, fcl::OBBd,
                   fcl::RSSd, fcl::kIOSd, fcl::OBBRSSd, fcl::KDOPd<16>, fcl::KDOPd<18>,
                   fcl::KDOPd<24>) {
  const auto model = makeModel<TestType>(boxMesh({1, 2, 3}));
  const fcl::CollisionGeometryd& geometry = *model;
  CHECK(kindOf(geometry) == GeometryKind::mesh);
  const void* visited = visitMesh(geometry, [](const auto& concrete) -> const void* {
    using Concrete = std::decay_t<decltype(concrete)>;
    return std::is_same_v<Concrete, fcl::BVHModel<TestType>> ? &concrete : nullptr;
  });
  CHECK(visited == model.get());
  const MeshView view = meshView(geometry);
  CHECK(view.vertex_count == 8);
  CHECK(view.triangle_count == 12);
  CHECK(view.node_count == 23);
  CHECK(view.vertices == model->vertices);
  CHECK(nodeTypeName(geometry.getNodeType()).find("BVHModel<") == 0);
}

TEST_CASE("shapes are not meshes") {
  const fcl::Sphered sphere(1.0);
  CHECK(kindOf(sphere) == GeometryKind::convex);
  CHECK(kindOf(fcl::Halfspaced()) == GeometryKind::unbounded);
  CHECK(kindOf(fcl::OcTreed(0.1)) == GeometryKind::octree);
  CHECK_THROWS_AS(meshView(sphere), fcl_prob::UnsupportedGeometry);
  CHECK_THROWS_WITH(meshView(sphere), Catch::Matchers::Contains("Sphere"));
}

TEST_CASE("polytopes give their vertices, round shapes none") {
  const auto corners = polytopeVertices(fcl::Boxd(1, 2, 4));
  REQUIRE(corners);
  CHECK(corners->size() == 8);
  Eigen::AlignedBox3d bounds;
  for (const auto& corner : *corners) bounds.extend(corner);
  CHECK(bounds.min() == Eigen::Vector3d(-0.5, -1, -2));
  CHECK(bounds.max() == Eigen::Vector3d(0.5, 1, 2));
  CHECK(polytopeVertices(fcl::TrianglePd({0, 0, 0}, {1, 0, 0}, {0, 1, 0}))->size() == 3);
  CHECK_FALSE(polytopeVertices(fcl::Capsuled(1, 2)));
}
