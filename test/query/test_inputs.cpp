// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Bad inputs are refused before any work, and the result is left alone.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/sphere.h>

#include <limits>

#include "catch.h"
#include "fcl_prob/fcl_prob.h"
#include "mesh_shapes.h"
#include "poses.h"

using namespace fcl_prob;
using namespace fcl_prob_test;
using Catch::Matchers::Contains;

namespace {

const GaussianDisplacement kDisplacement =
    GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});

ProbabilityResult marked() {
  ProbabilityResult result;
  result.estimate = 42;
  return result;
}

/// What the query throws, in words; checks that it did not touch the result.
std::string refusal(const fcl::CollisionGeometryd* a, const fcl::Transform3d& pose_a,
                    const fcl::CollisionGeometryd* b, const fcl::Transform3d& pose_b,
                    const ProbabilityRequest& request = {}) {
  ProbabilityResult result = marked();
  try {
    collisionProbability(a, pose_a, b, pose_b, kDisplacement, request, result);
  } catch (const Exception& exception) {
    CHECK(*result.estimate == 42);
    return exception.what();
  }
  return "";
}

}  // namespace

TEST_CASE("null and broken geometries are refused by the side they are on") {
  const fcl::Boxd box(1, 1, 1), flat(1, 1, 0);
  CHECK_THAT(refusal(nullptr, kIdentity, &box, kIdentity), Contains("object A"));
  CHECK_THAT(refusal(&box, kIdentity, nullptr, kIdentity), Contains("object B"));
  CHECK_THAT(refusal(&box, kIdentity, &flat, kIdentity),
             Contains("object B") && Contains("side z"));
  const fcl::BVHModel<fcl::OBBRSSd> empty;
  CHECK_THAT(refusal(&empty, kIdentity, &box, kIdentity),
             Contains("object A") && Contains("empty"));
  auto mesh = makeModel<fcl::OBBd>(boxMesh({1, 1, 1}));
  mesh->vertices[3][0] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(refusal(&box, kIdentity, mesh.get(), kIdentity),
             Contains("object B") && Contains("vertex 3"));
  ProbabilityResult result = marked();
  const fcl::CollisionObjectd object(std::make_shared<fcl::Boxd>(1, 1, 1));
  CHECK_THROWS_AS(collisionProbability(nullptr, &object, kDisplacement, {}, result),
                  InvalidGeometry);
  CHECK_THROWS_AS(collisionProbability(&object, nullptr, kDisplacement, {}, result),
                  InvalidGeometry);
  CHECK(*result.estimate == 42);
}

TEST_CASE("poses that are not rigid are refused") {
  const fcl::Boxd box(1, 1, 1);
  fcl::Transform3d scaled = kIdentity;
  scaled.linear() *= 1000;  // millimetres in the rotation
  CHECK_THAT(refusal(&box, scaled, &box, kIdentity), Contains("object A") && Contains("rigid"));
  fcl::Transform3d lost = kIdentity;
  lost.translation()[2] = std::numeric_limits<double>::infinity();
  CHECK_THAT(refusal(&box, kIdentity, &box, lost), Contains("object B") && Contains("inf"));
}

TEST_CASE("requests out of range are refused") {
  const fcl::Boxd box(1, 1, 1);
  ProbabilityRequest request;
  request.threshold = -0.1;
  CHECK_THAT(refusal(&box, kIdentity, &box, kIdentity, request),
             Contains("threshold") && Contains("-0.1"));
  request = {};
  request.threads = 0;
  CHECK_THAT(refusal(&box, kIdentity, &box, kIdentity, request), Contains("threads"));
}

TEST_CASE("open meshes are not solids") {
  TriangleMesh mesh = sphereMesh(1, 6, 8);
  mesh.triangles.pop_back();
  const auto open = makeModel<fcl::OBBRSSd>(mesh);
  const fcl::Boxd box(1, 1, 1);
  ProbabilityRequest request;
  request.contact = ContactMeaning::solid;
  CHECK_THAT(refusal(open.get(), kIdentity, &box, kIdentity, request),
             Contains("object A") && Contains("edge"));
}

TEST_CASE("a prepared query and the free functions answer alike, and write to no input") {
  const auto a = makeModel<fcl::OBBRSSd>(bumpyMesh(1, 8, 12, 1));
  const auto b = std::make_shared<fcl::Boxd>(1, 1, 1);
  const fcl::Transform3d pose_b(Eigen::Translation3d(1.3, 0.2, 0));
  const std::vector<Eigen::Vector3d> vertices(a->vertices, a->vertices + a->num_vertices);
  const fcl::CollisionObjectd object_a(a), object_b(b, pose_b);
  const ProbabilityRequest request;
  ProbabilityResult by_geometry, by_object, prepared;
  const double p = collisionProbability(a.get(), kIdentity, b.get(), pose_b, kDisplacement, request,
                                        by_geometry);
  CHECK(p == by_geometry.probability());
  CHECK(p > 0.01);
  CHECK(p < 0.99);
  CHECK(collisionProbability(&object_a, &object_b, kDisplacement, request, by_object) == p);
  PreparedQuery query(a, b);
  CHECK(query.collisionProbability(kIdentity, pose_b, kDisplacement, request, prepared) == p);
  PreparedQuery moved(std::move(query));
  CHECK(moved.collisionProbability(kIdentity, pose_b, kDisplacement, request, prepared) == p);
  for (int i = 0; i < a->num_vertices; ++i) CHECK(a->vertices[i] == vertices[i]);
  CHECK(object_a.getTransform().matrix() == kIdentity.matrix());
}

TEST_CASE("shapes of the largest size have an answer, larger ones are refused as geometry") {
  for (const double size : {1e100, 1e149}) {
    const fcl::Boxd box(size, size, 1);
    const fcl::Sphered sphere(size);
    for (const auto method :
         {ProbabilityMethod::automatic, ProbabilityMethod::interval, ProbabilityMethod::exact,
          ProbabilityMethod::convex_pcd, ProbabilityMethod::general_pcd}) {
      CAPTURE(size, toString(method));
      ProbabilityRequest request;
      request.method = method;
      request.max_cells = 10;
      ProbabilityResult result;
      collisionProbability(&box, kIdentity, &sphere, kIdentity, kDisplacement, request, result);
      CHECK(result.upper == 1.0);
      CHECK(result.lower.value_or(0.0) <= 1.0);
    }
  }
  const fcl::Boxd box(1, 1, 1);
  for (const double size : {1e151, 1e300, 1e308}) {
    const fcl::Sphered sphere(size);
    ProbabilityResult result;
    CHECK_THROWS_AS(
        collisionProbability(&box, kIdentity, &sphere, kIdentity, kDisplacement, {}, result),
        InvalidGeometry);
  }
}
