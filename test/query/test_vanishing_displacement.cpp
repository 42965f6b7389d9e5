// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Without uncertainty the query answers what fcl::collide answers.
#include <fcl/narrowphase/collision.h>

#include <random>

#include "catch.h"
#include "fcl_prob/fcl_prob.h"
#include "mesh_shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

fcl::Transform3d randomPose(std::mt19937_64& generator, double reach) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-reach, reach);
  fcl::Transform3d pose;
  pose =
      Eigen::Quaterniond(normal(generator), normal(generator), normal(generator), normal(generator))
          .normalized();
  pose.translation() << uniform(generator), uniform(generator), uniform(generator);
  return pose;
}

bool fclCollides(const fcl::CollisionGeometryd& a, const fcl::Transform3d& pose_a,
                 const fcl::CollisionGeometryd& b, const fcl::Transform3d& pose_b) {
  fcl::CollisionResultd result;
  fcl::collide(&a, pose_a, &b, pose_b, fcl::CollisionRequestd(), result);
  return result.isCollision();
}

}  // namespace

TEST_CASE("no covariance: 0 or 1, as fcl::collide on 10,000 random mesh poses") {
  const auto a = makeModel<fcl::OBBRSSd>(bumpyMesh(0.5, 8, 12, 1));
  const auto b = makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 12, 8));
  const PreparedQuery query(a, b);
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> step(-0.3, 0.3);
  int hits = 0;
  const int count = 10000;
  for (int i = 0; i < count; ++i) {
    const fcl::Transform3d pose_a = randomPose(generator, 0.75);
    const fcl::Transform3d pose_b = randomPose(generator, 0.75);
    const Eigen::Vector3d mean(step(generator), step(generator), step(generator));
    fcl::Transform3d displaced = pose_a;
    displaced.translation() += mean;
    const bool expected = fclCollides(*a, displaced, *b, pose_b);
    ProbabilityResult result;
    query.collisionProbability(pose_a, pose_b, GaussianDisplacement(mean, Eigen::Matrix3d::Zero()),
                               {}, result);
    REQUIRE(*result.lower == (expected ? 1.0 : 0.0));
    REQUIRE(*result.upper == *result.lower);
    REQUIRE(result.status == ProbabilityStatus::exact);
    hits += expected;
  }
  CHECK(hits > 0.3 * count);
  CHECK(hits < 0.7 * count);
}

TEST_CASE("no covariance: the threshold is decided and the plan says why") {
  const auto a = makeModel<fcl::OBBRSSd>(boxMesh({1, 1, 1}));
  const fcl::Transform3d identity = fcl::Transform3d::Identity();
  ProbabilityRequest request;
  request.threshold = 0.05;
  ProbabilityResult result;
  collisionProbability(a.get(), identity, a.get(), fcl::Transform3d(Eigen::Translation3d(3, 0, 0)),
                       GaussianDisplacement(), request, result);
  CHECK(result.decision == Decision::below);
  REQUIRE(!result.plan.empty());
  CHECK_THAT(result.plan.front(), Catch::Matchers::Contains("covariance is 0"));
  collisionProbability(a.get(), identity, a.get(),
                       fcl::Transform3d(Eigen::Translation3d(0.5, 0.2, 0.1)),
                       GaussianDisplacement(), request, result);
  CHECK(result.decision == Decision::above);
}

TEST_CASE("vanishing covariance: the certified interval closes around what fcl::collide answers") {
  const auto a = makeModel<fcl::OBBRSSd>(bumpyMesh(0.5, 8, 12, 1));
  const auto b = makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 12, 8));
  const PreparedQuery query(a, b);
  std::mt19937_64 generator(4);
  int hits = 0;
  int open = 0;
  const int count = 10000;
  for (int i = 0; i < count; ++i) {
    const fcl::Transform3d pose_a = randomPose(generator, 0.75);
    const fcl::Transform3d pose_b = randomPose(generator, 0.75);
    const auto displacement = GaussianDisplacement::fromStandardDeviations(
        {1e-9, 2e-9, 3e-9}, Eigen::Quaterniond(pose_b.linear()));
    ProbabilityResult result;
    query.collisionProbability(pose_a, pose_b, displacement, {}, result);
    const bool expected = fclCollides(*a, pose_a, *b, pose_b);
    hits += expected;
    // A pose within nanometres of touching may be anything in between.
    open += *result.upper > 0.01 && *result.lower < 0.99;
    if (*result.upper <= 0.01) REQUIRE_FALSE(expected);
    if (*result.lower >= 0.99) REQUIRE(expected);
  }
  CHECK(open <= 2);
  CHECK(hits > 0.3 * count);
  CHECK(hits < 0.7 * count);
}

TEST_CASE("no covariance: meshes of different bounding volumes are answered without FCL") {
  const TriangleMesh mesh_a = bumpyMesh(0.5, 8, 12, 1);
  const TriangleMesh mesh_b = torusMesh(0.5, 0.2, 12, 8);
  const auto obb = makeModel<fcl::OBBd>(mesh_a);
  const auto kdop = makeModel<fcl::KDOPd<24>>(mesh_b);
  const auto obb_b = makeModel<fcl::OBBd>(mesh_b);
  const PreparedQuery query(obb, kdop);
  std::mt19937_64 generator(5);
  int hits = 0;
  const int count = 500;
  for (int i = 0; i < count; ++i) {
    const fcl::Transform3d pose_a = randomPose(generator, 0.75);
    const fcl::Transform3d pose_b = randomPose(generator, 0.75);
    ProbabilityResult result;
    query.collisionProbability(pose_a, pose_b, GaussianDisplacement(), {}, result);
    const bool expected = fclCollides(*obb, pose_a, *obb_b, pose_b);
    // The partition widens even masses of 0 and 1 for rounding.
    REQUIRE(*result.lower >= (expected ? 1.0 - 1e-12 : 0.0));
    REQUIRE(*result.upper <= (expected ? 1.0 : 1e-290));
    hits += expected;
  }
  CHECK(hits > 0.3 * count);
  CHECK(hits < 0.7 * count);
}
