// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/nearly_convex.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "catch.h"
#include "dented_mesh.h"
#include "mesh_shapes.h"
#include "models.h"
#include "obj_file.h"
#include "partition_query.h"
#include "random_bodies.h"
#include "sampled_contact.h"

namespace {

using fcl_prob::ProbabilityResult;
using fcl_prob::TriangleMesh;
using namespace fcl_prob::detail;
using fcl_prob_test::bumpyMesh;
using fcl_prob_test::hullMesh;
using fcl_prob_test::PartitionQuery;
using fcl_prob_test::RandomBodies;
using fcl_prob_test::sphereMesh;
using fcl_prob_test::windingNumber;
using fcl_prob_test::withDents;

std::shared_ptr<const NearlyConvex> nearlyOf(const TriangleMesh& mesh) {
  return nearlyConvexOf(viewOf(mesh), mesh.vertices, Eigen::Vector3d::Zero());
}

// Points all over a body, most of them near its surface, are within the mesh.
void checkInside(const ConvexFan& body, const TriangleMesh& mesh, RandomBodies& random) {
  double share = 0.0;
  for (std::size_t f = 0; f < body.depths.size(); ++f) {
    share = std::max(share, body.depths[f] / body.offsets[f]);
  }
  CHECK(share < 1e-3);
  for (int k = 0; k < 30; ++k) {
    const Eigen::Vector3d direction = random.direction();
    double reach = 1e300;
    for (std::size_t f = 0; f < body.normals.size(); ++f) {
      const double along = body.normals[f].dot(direction);
      if (along > 0.0) reach = std::min(reach, body.offsets[f] / along);
    }
    const double part = k % 2 ? 1.0 - 2 * share - 1e-12 : random.uniform(0.0, 1.0 - 2 * share);
    CHECK(windingNumber(mesh, body.centre + part * reach * direction) > 0.5);
  }
}

bool isBetweenTwo(const ProbabilityResult& result) {
  return fcl_prob_test::planMentions(result, "nearly convex");
}

}  // namespace

TEST_CASE("dented bodies lie between a core and a hull", "[nearly_convex]") {
  RandomBodies random(1);
  int found = 0;
  for (int i = 0; i < 150; ++i) {
    const TriangleMesh body = i % 2 ? sphereMesh(0.3, random.integer(5, 12), random.integer(5, 16))
                                    : hullMesh(random.onSphere(random.integer(8, 80), 0.3));
    const TriangleMesh mesh =
        withDents(body, random.integer(1, 8), random.logUniform(1e-9, 3e-2), random);
    const auto nearly = nearlyOf(mesh);
    if (!nearly) continue;
    ++found;
    CHECK(nearly->share > 0.8);
    CHECK(nearly->share <= 1.0 + 1e-12);
    const ConvexFan& hull = nearly->hull;
    for (const Eigen::Vector3d& v : mesh.vertices) {
      for (std::size_t f = 0; f < hull.normals.size(); ++f) {
        REQUIRE(hull.normals[f].dot(v - hull.centre) <= hull.offsets[f]);
      }
    }
    checkInside(nearly->core, mesh, random);
  }
  CHECK(found > 100);
}

TEST_CASE("what is not closed, inside out or far from convex is not nearly so", "[nearly_convex]") {
  RandomBodies random(2);
  CHECK_FALSE(nearlyOf(fcl_prob_test::torusMesh(0.3, 0.1, 12, 8)));
  CHECK_FALSE(nearlyOf(bumpyMesh(0.3, 10, 12, 1)));
  const TriangleMesh dented = withDents(sphereMesh(0.3, 8, 10), 2, 0.01, random);
  CHECK(nearlyOf(dented));
  CHECK_FALSE(nearlyOf(fcl_prob_test::reversed(dented)));
  TriangleMesh open = dented;
  open.triangles.pop_back();
  CHECK_FALSE(nearlyOf(open));
  TriangleMesh far = dented;
  for (Eigen::Vector3d& v : far.vertices) v += Eigen::Vector3d(3, 0, 0);
  CHECK_FALSE(nearlyOf(fcl_prob_test::joined(dented, far)));
  // A cavity as large as the body.
  TriangleMesh hollow = dented;
  for (Eigen::Vector3d& v : hollow.vertices) v *= 0.9;
  CHECK_FALSE(nearlyOf(fcl_prob_test::joined(dented, fcl_prob_test::reversed(hollow))));
}

namespace {

// A smaller shell of either orientation within the body is in the core's way; one that reaches out
// of it is part of the hull.
void addShell(TriangleMesh& body, RandomBodies& random) {
  TriangleMesh shell = hullMesh(random.onSphere(8, random.uniform(0.01, 0.1)));
  const Eigen::Vector3d at = random.uniform(0.0, 0.35) * random.direction();
  for (Eigen::Vector3d& v : shell.vertices) v += at;
  if (random.integer(0, 1) == 0) shell = fcl_prob_test::reversed(shell);
  body = fcl_prob_test::joined(body, shell);
}

void checkDentedScenes(int scenes, int samples, unsigned seed) {
  RandomBodies random(seed);
  int between_two = 0;
  for (int i = 0; i < scenes; ++i) {
    TriangleMesh body = hullMesh(random.onSphere(random.integer(8, 60), random.uniform(0.1, 0.4)));
    body = withDents(body, random.integer(1, 6), random.logUniform(1e-6, 5e-2), random);
    const bool solid = i % 3 == 0;
    if (i % 6 == 1) addShell(body, random);
    const TriangleMesh other =
        bumpyMesh(random.uniform(0.2, 0.5), 10, 14, static_cast<std::uint64_t>(i));
    const bool swapped = i % 4 == 1;
    const double tolerance = i % 2 ? 0.1 : 0.03;
    INFO("scene " << i);
    const ProbabilityResult result = fcl_prob_test::checkedInterval(
        {body, other, swapped, solid, 0.2, 0.9, 0.03, 0.2, tolerance}, random, samples, random);
    between_two += isBetweenTwo(result);
  }
  CHECK(between_two > scenes / 4);
}

}  // namespace

TEST_CASE("intervals of dented bodies hold sampled probabilities",
          "[nearly_convex][random][slow]") {
  checkDentedScenes(60, 1'000, 31);
}

TEST_CASE("intervals of 3,000 dented bodies hold sampled probabilities",
          "[nearly_convex][random][long]") {
  checkDentedScenes(3'000, 3'000, 32);
}

// Where the two polytopes do not tell enough, boxes do.
TEST_CASE("a dented body has the interval that its triangles give", "[nearly_convex]") {
  RandomBodies random(4);
  const auto displacement =
      fcl_prob::GaussianDisplacement::fromStandardDeviations({0.03, 0.05, 0.04}, {1, 0, 0, 0});
  for (int i = 0; i < 6; ++i) {
    const TriangleMesh body = withDents(hullMesh(random.onSphere(30, 0.3)), 4, 2e-2, random);
    PartitionQuery query(body, bumpyMesh(0.5, 10, 14, static_cast<std::uint64_t>(i)));
    query.pose_b.translation() = Eigen::Vector3d(0.75, 0.1, 0.0);
    const ProbabilityResult rough = query.run(displacement, fcl_prob_test::intervalRequest(0.2));
    const ProbabilityResult fine = query.run(displacement, fcl_prob_test::intervalRequest(0.002));
    CAPTURE(i, *rough.lower, *rough.upper, *fine.lower, *fine.upper);
    CHECK(isBetweenTwo(rough));
    CHECK(fine.status == fcl_prob::ProbabilityStatus::converged);
    CHECK(*rough.lower <= *fine.upper);
    CHECK(*rough.upper >= *fine.lower);
  }
}

// Columns decide where they can, and lines estimate.
TEST_CASE("decisions and estimates of dented bodies agree with their intervals",
          "[nearly_convex]") {
  RandomBodies random(9);
  int by_columns = 0;
  for (int i = 0; i < 10; ++i) {
    TriangleMesh body = hullMesh(random.onSphere(random.integer(12, 60), 0.3));
    body = withDents(body, random.integer(1, 6), random.logUniform(1e-4, 3e-2), random);
    const TriangleMesh other = bumpyMesh(0.4, 10, 14, static_cast<std::uint64_t>(i));
    PartitionQuery query(i % 2 ? other : body, i % 2 ? body : other);
    if (i % 3 == 0) query.makeSolid();
    query.pose_b.linear() = random.rotation();
    query.pose_b.translation() = random.uniform(0.6, 0.9) * random.direction();
    const auto displacement = fcl_prob_test::obliqueDisplacement(0.05, 0.2, random);
    const ProbabilityResult truth = query.run(displacement, fcl_prob_test::intervalRequest(3e-3));
    CAPTURE(i, *truth.lower, *truth.upper);
    for (const double factor : {0.3, 0.8, 0.95, 1.05, 1.3, 3.0}) {
      auto request = fcl_prob_test::intervalRequest(1e-9);
      request.threshold = std::min(0.999, factor * truth.probability());
      const ProbabilityResult result = query.run(displacement, request);
      CAPTURE(factor, *result.lower, *result.upper);
      CHECK(*result.lower <= *truth.upper);
      CHECK(*result.upper >= *truth.lower);
      by_columns += fcl_prob_test::planMentions(result, "decided by bounds on");
    }
    auto request = fcl_prob_test::intervalRequest(0.01);
    request.method = fcl_prob::ProbabilityMethod::estimate;
    const ProbabilityResult estimate = query.run(displacement, request);
    CHECK(std::fabs(*estimate.estimate - truth.probability()) < 5 * *estimate.standard_error);
  }
  CHECK(by_columns > 30);
}

TEST_CASE("a can is nearly convex", "[nearly_convex][models]") {
  const auto path = fcl_prob_test::modelOrSkip("objects/coke_can_500.obj");
  if (!path) return;
  const auto can = nearlyOf(fcl_prob_test::readObj(*path));
  REQUIRE(can);
  CHECK(can->share > 0.97);
}
