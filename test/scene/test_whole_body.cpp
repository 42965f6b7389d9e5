// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Samples tested against convex meshes that are taken whole: against hulls of Minkowski sums and
// against FCL.
#include <fcl/narrowphase/collision.h>

#include <cmath>

#include "catch.h"
#include "cells/fat_obstacles.h"
#include "cells/node_reach.h"
#include "cells/whole_body_tester.h"
#include "fcl_prob/convex_polytope.h"
#include "partition_query.h"
#include "random_bodies.h"
#include "whitened_meshes.h"

namespace {

using fcl_prob::ConvexPolytope;
using fcl_prob::GaussianDisplacement;
using fcl_prob::ProbabilityMethod;
using fcl_prob::ProbabilityRequest;
using fcl_prob::ProbabilityResult;
using fcl_prob::TriangleMesh;
using namespace fcl_prob::detail;
using fcl_prob_test::bumpyMesh;
using fcl_prob_test::hullMesh;
using fcl_prob_test::PartitionQuery;
using fcl_prob_test::RandomBodies;
using fcl_prob_test::WhitenedMeshes;

const GaussianDisplacement kUnit(Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity());

std::unique_ptr<WholeBodyTester> testerOf(const WhitenedMeshes& meshes) {
  const PartitionObject a{meshes.tree_a.get(), {{fcl::Transform3d::Identity(), nullptr}}};
  const PartitionObject b{meshes.tree_b.get(), {{fcl::Transform3d::Identity(), nullptr}}};
  const auto whole = wholeBodyOf(a, b, kUnit, Convexity::exact);
  if (!whole) return nullptr;
  return WholeBodyTester::of(*whole, meshes.pair, meshes.whitening.matrix());
}

TriangleMesh randomTriangle(RandomBodies& random, const TriangleMesh& body, int kind) {
  TriangleMesh one;
  const double size = random.logUniform(0.01, 6.0);
  for (int k = 0; k < 3; ++k) one.vertices.push_back(size * random.normalVector());
  if (kind == 1) {
    // An edge along one of the body.
    one.vertices[1] = one.vertices[0] + size * (body.vertices[1] - body.vertices[0]);
  } else if (kind == 2) {
    // Hardly any area.
    one.vertices[2] = 0.5 * (one.vertices[0] + one.vertices[1]) + 1e-12 * random.normalVector();
  }
  one.triangles.emplace_back(0, 1, 2);
  return one;
}

/// Of y above the hull of all b - a.
double heightAbove(const ConvexPolytope& hull, const Eigen::Vector3d& y) {
  double height = -1e300;
  for (const ConvexPolytope::Face& face : hull.faces) {
    height = std::max(height, face.normal.dot(y) - face.offset);
  }
  return height;
}

bool collides(const WhitenedMeshes& meshes, const Eigen::Vector3d& y) {
  fcl::Transform3d moved = fcl::Transform3d::Identity();
  moved.translation() = y;
  fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  return fcl::collide(meshes.model_a.get(), moved, meshes.model_b.get(),
                      fcl::Transform3d::Identity(), request, result) > 0;
}

/// Whether what FCL says changes nearby.
bool isGrazing(const WhitenedMeshes& meshes, const Eigen::Vector3d& y) {
  const bool here = collides(meshes, y);
  for (int k = 0; k < 3; ++k) {
    for (const double step : {-1e-6, 1e-6}) {
      if (collides(meshes, y + step * Eigen::Vector3d::Unit(k)) != here) return true;
    }
  }
  return false;
}

bool isWhole(const ProbabilityResult& result) {
  return fcl_prob_test::planMentions(result, "taken whole");
}

}  // namespace

TEST_CASE("a convex mesh touches a triangle where the hull of their sum says so", "[whole]") {
  RandomBodies random(1);
  int touching = 0;
  int apart = 0;
  for (int scene = 0; scene < 90; ++scene) {
    const TriangleMesh body = hullMesh(random.onSphere(random.integer(4, 60), 1.0));
    const TriangleMesh one = randomTriangle(random, body, scene % 3);
    const bool body_is_a = scene % 2 == 0;
    const WhitenedMeshes meshes(body_is_a ? body : one, body_is_a ? one : body);
    const auto& tree = body_is_a ? meshes.tree_a : meshes.tree_b;
    const WhitenedFan fan(meshes.pair, tree->parts[0], *tree->parts[0].fan, body_is_a,
                          meshes.whitening.matrix());
    REQUIRE(fan.usable());
    FanContact contacts(fan);
    std::vector<Eigen::Vector3d> sum;
    for (const Eigen::Vector3d& a : meshes.tree_a->vertices) {
      for (const Eigen::Vector3d& b : meshes.tree_b->vertices) sum.push_back(b - a);
    }
    const Eigen::Vector3d apart_by =
        meshes.tree_b->parts[0].origin - meshes.tree_a->parts[0].origin;
    for (Eigen::Vector3d& v : sum) v += apart_by;
    const ConvexPolytope hull = fcl_prob::convexHull(sum);
    for (int i = 0; i < 100; ++i) {
      const auto vertex =
          static_cast<std::size_t>(random.integer(0, static_cast<int>(hull.vertices.size()) - 1));
      const Eigen::Vector3d y =
          random.uniform(0.7, 1.1) * hull.vertices[vertex] + 0.3 * random.normalVector();
      const double height = heightAbove(hull, y);
      const PointContact contact = contacts.with((-fan.corners(0)).colwise() + y);
      CAPTURE(scene, height);
      if (contact == PointContact::touching) CHECK(height <= 1e-9);
      if (contact == PointContact::none) CHECK(height >= -1e-9);
      if (contact == PointContact::unknown) CHECK(std::fabs(height) < 1e-9);
      touching += contact == PointContact::touching;
      apart += contact == PointContact::none;
    }
  }
  CHECK(touching > 2000);
  CHECK(apart > 2000);
}

// Of a node that a box is said to be clear of, no point of any triangle put to a vertex of the body
// is in the box; told of many boxes, or the test tells nothing.
TEST_CASE("boxes clear of nodes hold nothing of them", "[whole]") {
  RandomBodies random(7);
  int clear = 0;
  for (int scene = 0; scene < 12; ++scene) {
    const TriangleMesh body = hullMesh(random.onSphere(random.integer(4, 60), 0.4));
    const TriangleMesh other = bumpyMesh(0.5, 8, 10, static_cast<std::uint64_t>(scene));
    const bool body_is_a = scene % 2 == 0;
    const WhitenedMeshes meshes(body_is_a ? body : other, body_is_a ? other : body);
    const auto& tree = body_is_a ? meshes.tree_a : meshes.tree_b;
    const Eigen::Matrix3d& matrix = meshes.whitening.matrix();
    const PatchedMesh pieces(body_is_a ? meshes.pair.b : meshes.pair.a, meshes.objectOf(!body_is_a),
                             matrix, PatchUse{});
    const FatObstacles obstacles(meshes.pair, tree->parts[0], *tree->parts[0].fan, body_is_a,
                                 matrix, pieces);
    const NodeReach reach(obstacles, pieces);
    const auto& nodes = pieces.nodes();
    for (int i = 0; i < 40; ++i) {
      const Eigen::Vector3d middle = 0.6 * random.normalVector();
      const Eigen::Vector3d half = Eigen::Vector3d::Constant(random.logUniform(1e-3, 0.3));
      const NodeReach::Heights lowest = reach.lowestOf(middle, half);
      const NodeReach::Heights highest = reach.highestOf(middle, half);
      for (int node = 0; node < static_cast<int>(nodes.size()); ++node) {
        CHECK(reach.leastOver(highest, node) <= reach.leastOver(lowest, node));
        if (!reach.isClearOf(lowest, node)) continue;
        ++clear;
        if (nodes[node].left >= 0) {
          CHECK(reach.isClearOf(lowest, nodes[node].left));
          CHECK(reach.isClearOf(lowest, nodes[node].right));
          continue;
        }
        const Eigen::Matrix3d corners = obstacles.corners(nodes[node].piece);
        bool is_apart = false;
        for (int f = 0; f < obstacles.faceCount(); ++f) {
          const Eigen::Vector3d& n = obstacles.faceNormal(f);
          const double below = n.dot(middle) - n.cwiseAbs().dot(half);
          const double highest = (n.transpose() * corners).maxCoeff() + obstacles.faceOffset(f);
          is_apart = is_apart || below > highest;
        }
        CHECK(is_apart);
      }
    }
  }
  CHECK(clear > 2'000);
}

TEST_CASE("convex meshes taken whole touch others where fcl::collide says so", "[whole]") {
  RandomBodies random(2);
  int touching = 0;
  int apart = 0;
  for (int scene = 0; scene < 12; ++scene) {
    const TriangleMesh body = fcl_prob_test::transformed(
        hullMesh(random.onSphere(random.integer(20, 300), random.uniform(0.2, 0.6))),
        Eigen::Isometry3d(Eigen::Translation3d(random.normalVector())));
    const TriangleMesh other = bumpyMesh(1.0, 12, 16, static_cast<std::uint64_t>(scene));
    const bool body_is_a = scene % 2 == 0;
    const WhitenedMeshes meshes(body_is_a ? body : other, body_is_a ? other : body);
    const auto tester = testerOf(meshes);
    REQUIRE(tester);
    const Eigen::Vector3d middle = meshes.tree_b->parts[0].origin - meshes.tree_a->parts[0].origin;
    for (int i = 0; i < 400; ++i) {
      const Eigen::Vector3d y = middle + random.uniform(0.5, 1.8) * random.direction();
      const PointContact contact = tester->at(y);
      CHECK(contact != PointContact::unknown);
      if ((contact == PointContact::touching) != collides(meshes, y)) CHECK(isGrazing(meshes, y));
      touching += contact == PointContact::touching;
      apart += contact == PointContact::none;
    }
  }
  CHECK(touching > 500);
  CHECK(apart > 500);
}

TEST_CASE("a triangle through a body of a thousand faces is no doubt", "[whole]") {
  RandomBodies random(3);
  const TriangleMesh body = hullMesh(random.onSphere(800, 1.0));
  TriangleMesh large = fcl_prob_test::boxMesh({40, 40, 0.01});
  const WhitenedMeshes meshes(body, large);
  const auto tester = testerOf(meshes);
  REQUIRE(tester);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d y = random.normalVector();
    if (std::fabs(std::fabs(y.z()) - 1.0) < 0.05) continue;
    CAPTURE(y);
    CHECK(tester->at(y) == (std::fabs(y.z()) < 1.0 ? PointContact::touching : PointContact::none));
  }
}

TEST_CASE("what is small enough to be inside a surface is not taken whole", "[whole]") {
  const WhitenedMeshes meshes(fcl_prob_test::sphereMesh(1.0, 20, 30),
                              fcl_prob_test::boxMesh({0.2, 0.2, 0.2}));
  CHECK_FALSE(testerOf(meshes));
}

TEST_CASE("estimates of convex meshes taken whole agree with intervals", "[whole]") {
  RandomBodies random(4);
  int whole = 0;
  for (int scene = 0; scene < 12; ++scene) {
    PartitionQuery query(hullMesh(random.onSphere(random.integer(20, 200), 0.5)),
                         bumpyMesh(0.7, 12, 16, static_cast<std::uint64_t>(scene)));
    query.pose_a.linear() = random.rotation();
    query.pose_a.translation() = random.uniform(1.1, 1.5) * random.direction();
    const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.15});
    const ProbabilityResult interval =
        query.run(displacement, fcl_prob_test::intervalRequest(1e-3));
    ProbabilityRequest request;
    request.method = ProbabilityMethod::estimate;
    request.relative_tolerance = 0.01;
    request.gradient = scene % 2 == 0;
    const ProbabilityResult estimate = query.run(displacement, request);
    whole += isWhole(estimate);
    CAPTURE(scene, *interval.lower, *interval.upper, *estimate.estimate, *estimate.standard_error);
    CHECK(*estimate.estimate <= *interval.upper + 5 * *estimate.standard_error);
    CHECK(*estimate.estimate >= *interval.lower - 5 * *estimate.standard_error);
  }
  CHECK(whole == 12);
}
