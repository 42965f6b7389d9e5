// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What the partition claims of its cells, against the oracle, over assorted scenes.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/sphere.h>

#include "catch.h"
#include "fcl_prob/group.h"
#include "mesh_shapes.h"
#include "oracle/claim_checker.h"
#include "shapes.h"

using namespace fcl_prob_test;
using fcl_prob::ContactMeaning;
using fcl_prob::GaussianDisplacement;
using fcl_prob::ProbabilityMethod;
using fcl_prob::ProbabilityRequest;
using oracle::checkClaims;
using oracle::ClaimBudget;
using oracle::ClaimReport;

namespace {

ProbabilityRequest interval(ContactMeaning contact = ContactMeaning::fcl) {
  ProbabilityRequest request;
  request.method = ProbabilityMethod::interval;
  request.contact = contact;
  request.relative_tolerance = 0.02;
  request.max_cells = 3000;
  return request;
}

void checkReport(const ClaimReport& report) {
  INFO(report.table());
  for (const oracle::Violation& violation : report.violations) UNSCOPED_INFO(violation.text);
  CHECK(report.total().violated == 0);
}

}  // namespace

TEST_CASE("Claims of all pairs of kinds of shapes") {
  RandomBodies random(1201);
  std::vector<NamedGeometry> all = boundedShapes();
  for (const NamedGeometry& mesh : meshes()) all.push_back(mesh);
  all.push_back({"OcTree", randomOcTree(30, 0.1, 0.5, 3)});
  ClaimReport sum;
  for (const NamedGeometry& a : all) {
    for (const NamedGeometry& b : all) {
      INFO(a.name << " and " << b.name);
      const fcl::Transform3d pose_a(random.pose(0.3)), pose_b(random.pose(1.5));
      const ClaimReport report = checkClaims({a.geometry.get(), pose_a}, {b.geometry.get(), pose_b},
                                             randomDisplacement(random, 0.01, 0.3), interval(),
                                             ClaimBudget{150, 2, 2}, random.integer(0, 1 << 30));
      checkReport(report);
      sum += report;
    }
  }
  CHECK(sum.total().checked > 5000);
  CHECK(sum.total().undecided < 100);
}

TEST_CASE("Claims of shells, strays and voxels, each within a larger solid") {
  const TriangleMesh cube = boxMesh({0.2, 0.2, 0.2});
  TriangleMesh point;
  point.vertices.assign(3, {10, 0, 0});
  point.triangles.emplace_back(0, 1, 2);
  const auto moved = transformed(cube, Eigen::Isometry3d(Eigen::Translation3d(10, 0, 0)));
  const auto shells = makeModel<fcl::OBBRSSd>(joined(cube, moved));
  const auto stray = makeModel<fcl::OBBRSSd>(joined(cube, point));
  const auto voxels = randomOcTree(6, 0.2, 5.0, 4);
  const auto large = makeModel<fcl::OBBRSSd>(boxMesh({4, 4, 4}));
  const fcl::Transform3d at_origin = fcl::Transform3d::Identity();
  const GaussianDisplacement error(Eigen::Vector3d::Zero(), 0.01 * Eigen::Matrix3d::Identity());
  for (const fcl::CollisionGeometryd* several :
       {static_cast<const fcl::CollisionGeometryd*>(shells.get()),
        static_cast<const fcl::CollisionGeometryd*>(stray.get()),
        static_cast<const fcl::CollisionGeometryd*>(voxels.get())}) {
    const oracle::Placed a{several, at_origin}, b{large.get(), at_origin};
    const ProbabilityRequest request = interval(ContactMeaning::solid);
    checkReport(checkClaims(a, b, error, request, ClaimBudget{600, 3, 2}, 1));
    checkReport(checkClaims(b, a, error, request, ClaimBudget{600, 3, 2}, 2));
  }
}

// Large enough for proofs by topology.
TEST_CASE("Claims of meshes of hundreds of triangles, closed and open, as surfaces and as solids") {
  RandomBodies random(1202);
  ClaimReport sum;
  for (int trial = 0; trial < 6; ++trial) {
    const bool solid = trial % 2 == 0;
    const auto mesh = [&](double radius) {
      TriangleMesh result = bumpyMesh(radius, 16, 20, trial);
      const int count = static_cast<int>(result.triangles.size());
      if (!solid) result.triangles.resize(static_cast<std::size_t>(random.integer(500, count)));
      return makeModel<fcl::OBBRSSd>(result);
    };
    // Now and then one of them within the other.
    const bool within = trial % 3 == 0;
    const auto a = mesh(within ? 0.2 : 0.7), b = mesh(1.0);
    const fcl::Transform3d pose_a(random.pose(0.1)), pose_b(random.pose(within ? 0.3 : 1.6));
    ProbabilityRequest request = interval(solid ? ContactMeaning::solid : ContactMeaning::fcl);
    request.relative_tolerance = 1e-3;
    request.max_cells = 800;
    const ClaimReport report =
        checkClaims({a.get(), pose_a}, {b.get(), pose_b}, randomDisplacement(random, 0.05, 0.3),
                    request, ClaimBudget{300, 2, 2}, random.integer(0, 1 << 30));
    checkReport(report);
    sum += report;
  }
  CHECK(sum.by_method["crossing surfaces"].checked > 20);
}

// Of several meshes a vertex is inside an odd number of them, also where they overlap.
TEST_CASE("Claims of groups of meshes that overlap, closed and open, as surfaces and as solids") {
  RandomBodies random(1204);
  ClaimReport sum;
  for (int trial = 0; trial < 8; ++trial) {
    const bool solid = trial % 2 == 0;
    const auto mesh = [&](double radius, int seed) {
      TriangleMesh result = bumpyMesh(radius, 14, 20, seed);
      const int count = static_cast<int>(result.triangles.size());
      if (!solid) result.triangles.resize(static_cast<std::size_t>(random.integer(400, count)));
      return makeModel<fcl::OBBRSSd>(result);
    };
    fcl_prob::GroupQuery::Geometries links{mesh(0.5, trial), mesh(0.4, trial + 20), mesh(0.2, 3)};
    std::vector<fcl::Transform3d> at;
    std::vector<oracle::Placed> placed;
    for (const auto& link : links) {
      at.emplace_back(random.pose(0.5));
      placed.push_back({link.get(), at.back()});
    }
    const fcl_prob::GroupQuery::Geometries other{mesh(1.0, trial + 40)};
    const fcl::Transform3d pose(random.pose(1.5));
    ProbabilityRequest request = interval(solid ? ContactMeaning::solid : ContactMeaning::fcl);
    request.relative_tolerance = 1e-3;
    request.max_cells = 800;
    const GaussianDisplacement error = randomDisplacement(random, 0.05, 0.3);
    const bool first = trial % 4 < 2;
    const auto ask = [&] {
      fcl_prob::ProbabilityResult result;
      if (first) {
        fcl_prob::GroupQuery(links, other).collisionProbability(at, {pose}, error, request, result);
      } else {
        fcl_prob::GroupQuery(other, links).collisionProbability({pose}, at, error, request, result);
      }
    };
    const std::vector<oracle::Placed> alone{{other[0].get(), pose}};
    const oracle::Scene scene(first ? placed : alone, first ? alone : placed,
                              solid ? oracle::Contact::solid : oracle::Contact::surface);
    const ClaimReport report =
        checkClaims(scene, ask, ClaimBudget{300, 2, 2}, random.integer(0, 1 << 30));
    checkReport(report);
    sum += report;
  }
  CHECK(sum.by_method["crossing surfaces"].checked > 20);
}

// Cells at edges, between what is covered by one pair and what others reach.
TEST_CASE("Claims where faces of coarse meshes meet") {
  RandomBodies random(1203);
  ClaimReport sum;
  for (int trial = 0; trial < 12; ++trial) {
    const auto a = makeModel<fcl::OBBRSSd>(bumpyMesh(0.5, 6, 8, trial));
    const auto b = makeModel<fcl::OBBRSSd>(bumpyMesh(0.6, 8, 10, trial + 10));
    ProbabilityRequest request = interval();
    request.relative_tolerance = 1e-3;
    const ClaimReport report = checkClaims({a.get(), fcl::Transform3d(random.pose(0.1))},
                                           {b.get(), fcl::Transform3d(random.pose(1.2))},
                                           randomDisplacement(random, 0.05, 0.3), request,
                                           ClaimBudget{400, 2, 2}, random.integer(0, 1 << 30));
    checkReport(report);
    sum += report;
  }
  CHECK(sum.by_method["below what is possible"].checked > 60);
}

TEST_CASE("The checker finds claims that are wrong") {
  // Told of a shape that is a little larger or smaller than the one asked about.
  const auto box = makeModel<fcl::OBBRSSd>(boxMesh({0.5, 0.5, 0.5}));
  const fcl::Sphered ball(0.5), larger(0.505), smaller(0.495);
  const auto bumpy = [](double size) {
    return makeModel<fcl::OBBRSSd>(bumpyMesh(0.5 * size, 8, 10, 1));
  };
  const auto mesh = bumpy(1.0), larger_mesh = bumpy(1.002), smaller_mesh = bumpy(0.998);
  const fcl::Transform3d at_origin = fcl::Transform3d::Identity();
  fcl::Transform3d beside = at_origin;
  beside.translation() = Eigen::Vector3d(1.1, 0.2, 0.1);
  const GaussianDisplacement error(Eigen::Vector3d::Zero(), 0.01 * Eigen::Matrix3d::Identity());
  const auto violations = [&](const fcl::CollisionGeometryd& asked,
                              const fcl::CollisionGeometryd& told) {
    const oracle::Scene scene({&told, at_origin}, {box.get(), beside}, oracle::Contact::surface);
    ProbabilityRequest request = interval();
    request.relative_tolerance = 1e-4;
    fcl_prob::ProbabilityResult result;
    const auto query = [&] {
      fcl_prob::collisionProbability(&asked, at_origin, box.get(), beside, error, request, result);
    };
    return checkClaims(scene, query, ClaimBudget{}, 5).total().violated;
  };
  CHECK(violations(*mesh, *mesh) == 0);
  CHECK(violations(*mesh, *larger_mesh) > 0);
  CHECK(violations(*mesh, *smaller_mesh) > 0);
  CHECK(violations(ball, ball) == 0);
  CHECK(violations(ball, larger) > 0);
  CHECK(violations(ball, smaller) > 0);
}

TEST_CASE("Claims of convex meshes that are taken whole") {
  RandomBodies random(1203);
  ClaimReport sum;
  for (int i = 0; i < 16; ++i) {
    TriangleMesh body = i % 4 == 0 ? boxMesh({0.3, 0.2, 0.15}) : sphereMesh(0.2, 4 + i, 5 + i);
    body = transformed(body, random.pose(0.2));
    if (i % 2 == 0) {
      for (Eigen::Vector3d& v : body.vertices) v = v.cast<float>().cast<double>();
    }
    const auto convex = makeModel<fcl::OBBRSSd>(body);
    const auto other = makeModel<fcl::OBBRSSd>(bumpyMesh(0.6, 10, 12, 7 + i));
    const fcl::Transform3d pose_a(random.pose(0.3)), pose_b(random.pose(0.9));
    ProbabilityRequest request = interval(i % 3 == 0 ? ContactMeaning::solid : ContactMeaning::fcl);
    request.relative_tolerance = 0.005;
    const oracle::Placed a{convex.get(), pose_a};
    const oracle::Placed b{other.get(), pose_b};
    const bool swapped = i % 4 == 1;
    const ClaimReport report =
        checkClaims(swapped ? b : a, swapped ? a : b, randomDisplacement(random, 0.02, 0.2),
                    request, ClaimBudget{600, 2, 2}, random.integer(0, 1 << 30));
    INFO("scene " << i);
    checkReport(report);
    sum += report;
  }
  INFO(sum.table());
  CHECK(sum.by_method["planes of a fat pair"].checked > 500);
  CHECK(sum.by_method["no fat pair"].checked > 500);
  CHECK(sum.total().undecided < 100);
}
