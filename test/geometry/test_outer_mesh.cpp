// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>

#include <random>

#include "catch.h"
#include "closed_meshes.h"
#include "geometry/closed_mesh.h"
#include "geometry/outer_mesh.h"
#include "mesh_shapes.h"

using namespace fcl_prob::detail;
using namespace fcl_prob_test;

namespace {

constexpr double kTolerance = 0.01;

/// Support value of a round shape of FCL in a unit direction.
double support(const fcl::CollisionGeometryd& shape, const Eigen::Vector3d& u) {
  const double across = std::hypot(u.x(), u.y());
  switch (shape.getNodeType()) {
    case fcl::GEOM_SPHERE:
      return static_cast<const fcl::Sphered&>(shape).radius;
    case fcl::GEOM_ELLIPSOID:
      return static_cast<const fcl::Ellipsoidd&>(shape).radii.cwiseProduct(u).norm();
    case fcl::GEOM_CAPSULE: {
      const auto& capsule = static_cast<const fcl::Capsuled&>(shape);
      return capsule.radius + 0.5 * capsule.lz * std::abs(u.z());
    }
    case fcl::GEOM_CYLINDER: {
      const auto& cylinder = static_cast<const fcl::Cylinderd&>(shape);
      return cylinder.radius * across + 0.5 * cylinder.lz * std::abs(u.z());
    }
    default: {
      const auto& cone = static_cast<const fcl::Coned&>(shape);
      return std::max(0.5 * cone.lz * u.z(), cone.radius * across - 0.5 * cone.lz * u.z());
    }
  }
}

}  // namespace

TEST_CASE("polyhedra around curved shapes contain them and exceed them little") {
  const fcl::Sphered sphere(0.8);
  const fcl::Ellipsoidd ellipsoid(1, 0.3, 0.6);
  const fcl::Capsuled capsule(0.4, 1.5);
  const fcl::Cylinderd cylinder(0.5, 0.7);
  const fcl::Coned cone(0.5, 1.2);
  std::mt19937_64 generator(4);
  std::normal_distribution<double> normal;
  for (const fcl::CollisionGeometryd* shape : std::initializer_list<const fcl::CollisionGeometryd*>{
           &sphere, &ellipsoid, &capsule, &cylinder, &cone}) {
    INFO(nodeTypeName(shape->getNodeType()));
    const TriangleMesh mesh = outerMesh(*shape, {kTolerance, Eigen::Vector3d::Zero(), 0.0});
    CHECK_FALSE(opennessOf(meshView(*makeModel<fcl::OBBRSSd>(mesh))));
    // Every face is a supporting plane of a convex body that contains the shape.
    for (const auto& t : mesh.triangles) {
      const Eigen::Vector3d& p = mesh.vertices[t[0]];
      const Eigen::Vector3d area = (mesh.vertices[t[1]] - p).cross(mesh.vertices[t[2]] - p);
      if (area.norm() < 1e-12) continue;  // the middle of a flat end
      const Eigen::Vector3d n = area.normalized();
      REQUIRE(n.dot(p) >= support(*shape, n) - 1e-12);
      for (const auto& v : mesh.vertices) REQUIRE(n.dot(v) <= n.dot(p) + 1e-12);
    }
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Vector3d u =
          Eigen::Vector3d(normal(generator), normal(generator), normal(generator)).normalized();
      double reach = -1e9;
      for (const auto& v : mesh.vertices) reach = std::max(reach, u.dot(v));
      REQUIRE(reach >= support(*shape, u) - 1e-12);
      REQUIRE(reach <= support(*shape, u) + 2 * kTolerance);
    }
  }
}

TEST_CASE("a half-space is a box and a plane a square within the reach") {
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, 2) / 3;
  const Eigen::Vector3d centre(5, -3, 1);
  const OuterMeshRequest request{kTolerance, centre, 4.0};
  for (double offset : {-2.0, normal.dot(centre), 7.0}) {
    const ClosedMesh box = closedMesh(outerMesh(fcl::Halfspaced(normal, offset), request));
    std::mt19937_64 generator(5);
    std::uniform_real_distribution<double> step(-2.3, 2.3);
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Vector3d p =
          centre + Eigen::Vector3d(step(generator), step(generator), step(generator));
      const bool inside = normal.dot(p) <= offset;
      REQUIRE(box.contains(p) == (inside ? Containment::inside : Containment::outside));
    }
    for (const auto& v : outerMesh(fcl::Planed(normal, offset), request).vertices) {
      CHECK(normal.dot(v) == Approx(offset));
    }
  }
}

TEST_CASE("flat shapes, meshes and octrees keep their surface") {
  const OuterMeshRequest request{kTolerance, Eigen::Vector3d::Zero(), 0.0};
  const ClosedMesh box = closedMesh(outerMesh(fcl::Boxd(1, 2, 3), request));
  CHECK(box.contains({0.49, 0.99, 1.49}) == Containment::inside);
  CHECK(box.contains({0.51, 0.99, 1.49}) == Containment::outside);

  const TriangleMesh torus = torusMesh(1, 0.3, 8, 6);
  const TriangleMesh copy = outerMesh(*makeModel<fcl::KDOPd<18>>(torus), request);
  CHECK(copy.vertices == torus.vertices);
  CHECK(copy.triangles.size() == torus.triangles.size());

  const std::vector<Eigen::Vector3d> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<int> faces = {3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 0, 3, 2};
  const fcl::Convexd tetrahedron(std::make_shared<const std::vector<Eigen::Vector3d>>(vertices), 4,
                                 std::make_shared<const std::vector<int>>(faces));
  const ClosedMesh solid = closedMesh(outerMesh(tetrahedron, request));
  CHECK(solid.contains({0.3, 0.3, 0.3}) == Containment::inside);
  CHECK(solid.contains({0.4, 0.4, 0.4}) == Containment::outside);

  auto tree = std::make_shared<octomap::OcTree>(0.5);
  tree->updateNode(0.25, 0.25, 0.25, true);
  tree->updateNode(1.25, 0.25, 0.25, true);
  const TriangleMesh cells =
      outerMesh(fcl::OcTreed(std::shared_ptr<const octomap::OcTree>(tree)), request);
  CHECK(cells.triangles.size() == 24);
  CHECK(closedMesh(cells).contains({1.1, 0.1, 0.4}) == Containment::inside);
  CHECK(closedMesh(cells).contains({0.75, 0.1, 0.4}) == Containment::outside);
}
