// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/monte_carlo.h"

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/sphere.h>

#include "benchmark_scenes.h"
#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/normal_mass.h"
#include "mesh_shapes.h"
#include "poses.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

ProbabilityRequest requestOf(std::size_t samples) {
  ProbabilityRequest request;
  request.samples = samples;
  request.relative_tolerance = 1e-9;
  request.absolute_tolerance = 0;
  return request;
}

/// P of two axis-aligned boxes: a product of three interval masses.
double boxProbability(const Eigen::Vector3d& sides_a, const Eigen::Vector3d& sides_b,
                      const Eigen::Vector3d& b_minus_a, const Eigen::Vector3d& sigma) {
  const Eigen::Vector3d half = 0.5 * (sides_a + sides_b);
  return normalBoxMass((b_minus_a - half).cwiseQuotient(sigma),
                       (b_minus_a + half).cwiseQuotient(sigma));
}

void checkWithin(const ProbabilityResult& result, double expected, double standard_errors) {
  REQUIRE(result.estimate);
  REQUIRE(result.standard_error);
  CHECK(std::abs(*result.estimate - expected) <= standard_errors * *result.standard_error);
}

}  // namespace

TEST_CASE("the benchmark scenes agree with their reference", "[slow]") {
  for (const std::string& name : benchmarkSceneNames()) {
    const auto scene = benchmarkSceneOrSkip(name);
    if (!scene) return;
    const auto a = makeModel<fcl::OBBRSSd>(scene->a);
    const auto b = makeModel<fcl::OBBRSSd>(scene->b);
    const ProbabilityResult result = monteCarloProbability(*a, scene->pose_a, *b, scene->pose_b,
                                                           scene->displacement, requestOf(10000));
    INFO(name << ": " << *result.estimate << " +- " << *result.standard_error);
    checkWithin(result, scene->estimate, 4);
    CHECK(*result.standard_error < 0.006);
    CHECK_FALSE(result.lower);
    CHECK_FALSE(result.upper);
    CHECK(result.status == ProbabilityStatus::sampled);
  }
}

TEST_CASE("axis-aligned boxes agree with the product of normal masses, as shapes and as meshes") {
  const Eigen::Vector3d sides_a(1, 0.5, 2), sides_b(0.3, 1, 0.7), sigma(0.3, 0.2, 0.5);
  const Eigen::Vector3d offset(0.9, -0.4, 1.1), mean(0.1, 0.05, -0.2);
  const double expected = boxProbability(sides_a, sides_b, offset - mean, sigma);
  REQUIRE(expected > 0.1);
  REQUIRE(expected < 0.9);
  const auto displacement =
      GaussianDisplacement::fromStandardDeviations(sigma, Eigen::Quaterniond::Identity(), mean);
  const fcl::Boxd a(sides_a), b(sides_b);
  checkWithin(
      monteCarloProbability(a, kIdentity, b, at(0.9, -0.4, 1.1), displacement, requestOf(40000)),
      expected, 4);
  const auto mesh_a = makeModel<fcl::OBBd>(boxMesh(sides_a));
  checkWithin(monteCarloProbability(*mesh_a, kIdentity, b, at(0.9, -0.4, 1.1), displacement,
                                    requestOf(40000)),
              expected, 4);
}

TEST_CASE("covariances of every rank and direction") {
  const fcl::Boxd a(1, 1, 1), b(1, 1, 1);
  const Eigen::Quaterniond axes(
      Eigen::AngleAxisd(0.5 * 3.14159265358979324, Eigen::Vector3d(0, 0, 1)));
  const auto along_y = GaussianDisplacement::fromStandardDeviations({0.5, 0, 0}, axes);
  checkWithin(monteCarloProbability(a, kIdentity, b, at(0, 1.5, 0), along_y, requestOf(20000)),
              normalTailMass(1.0) - normalTailMass(5.0), 4);
  CHECK(*monteCarloProbability(a, kIdentity, b, at(1.5, 0, 0), along_y, requestOf(2000)).estimate ==
        0.0);
  const GaussianDisplacement fixed;
  CHECK(*monteCarloProbability(a, kIdentity, b, at(0.9, 0, 0), fixed, requestOf(10)).estimate ==
        1.0);
}

TEST_CASE("the seed fixes all samples on any number of threads") {
  const auto a = makeModel<fcl::OBBRSSd>(bumpyMesh(1, 10, 16, 1));
  const auto b = makeModel<fcl::OBBRSSd>(bumpyMesh(1, 10, 16, 2));
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.3, 0.2, 0.1});
  ProbabilityRequest request = requestOf(5000);
  request.gradient = true;
  const auto reference =
      monteCarloProbability(*a, kIdentity, *b, at(2.1, 0, 0), displacement, request);
  REQUIRE(reference.statistics.hits > 500);
  REQUIRE(reference.statistics.hits < 4500);
  for (unsigned threads : {2u, 3u, 8u}) {
    request.threads = threads;
    const auto result =
        monteCarloProbability(*a, kIdentity, *b, at(2.1, 0, 0), displacement, request);
    CHECK(result.statistics.hits == reference.statistics.hits);
    CHECK(*result.gradient == *reference.gradient);
    CHECK(result.confidence_interval->lower == reference.confidence_interval->lower);
  }
  request.seed = 2;
  const auto other = monteCarloProbability(*a, kIdentity, *b, at(2.1, 0, 0), displacement, request);
  CHECK(other.statistics.hits != reference.statistics.hits);
}

TEST_CASE("models that FCL would rebuild in every call give the same answers") {
  const TriangleMesh mesh_a = bumpyMesh(1, 8, 12, 1);
  const TriangleMesh mesh_b = bumpyMesh(1, 8, 12, 2);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.3, 0.2, 0.1});
  const auto hits = [&](const auto& a, const auto& b) {
    return monteCarloProbability(*a, kIdentity, *b, at(2.1, 0.1, 0), displacement, requestOf(2000))
        .statistics.hits;
  };
  const std::size_t expected =
      hits(makeModel<fcl::OBBRSSd>(mesh_a), makeModel<fcl::OBBRSSd>(mesh_b));
  CHECK(expected > 200);
  CHECK(hits(makeModel<fcl::AABBd>(mesh_a), makeModel<fcl::AABBd>(mesh_b)) == expected);
  CHECK(hits(makeModel<fcl::RSSd>(mesh_a), makeModel<fcl::RSSd>(mesh_b)) == expected);
  CHECK(hits(makeModel<fcl::KDOPd<18>>(mesh_a), makeModel<fcl::KDOPd<18>>(mesh_b)) == expected);
  const fcl::Sphered ball(0.7);
  const auto hits_of_ball = [&](const auto& a) {
    return monteCarloProbability(*a, kIdentity, ball, at(1.6, 0.1, 0), displacement,
                                 requestOf(2000))
        .statistics.hits;
  };
  CHECK(hits_of_ball(makeModel<fcl::AABBd>(mesh_a)) ==
        hits_of_ball(makeModel<fcl::OBBRSSd>(mesh_a)));
}

TEST_CASE("a model that is not occupied never collides, as in FCL") {
  auto a = makeModel<fcl::AABBd>(boxMesh({1, 1, 1}));
  auto b = makeModel<fcl::AABBd>(boxMesh({1, 1, 1}));
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.01, 0.01, 0.01});
  CHECK(*monteCarloProbability(*a, kIdentity, *b, at(0.5, 0.3, 0.1), displacement, requestOf(100))
             .estimate == 1.0);
  a->cost_density = 0.0;
  CHECK(*monteCarloProbability(*a, kIdentity, *b, at(0.5, 0.3, 0.1), displacement, requestOf(100))
             .estimate == 0.0);
}

TEST_CASE("solids collide when one contains the other, surfaces do not") {
  const auto outer = makeModel<fcl::OBBRSSd>(torusMesh(2, 0.8, 24, 16));
  const auto inner = makeModel<fcl::OBBRSSd>(sphereMesh(0.2, 6, 8));
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.01, 0.01, 0.01});
  ProbabilityRequest request = requestOf(200);
  const auto probability = [&](const auto& a, const fcl::Transform3d& pose_a, const auto& b,
                               const fcl::Transform3d& pose_b) {
    return *monteCarloProbability(a, pose_a, b, pose_b, displacement, request).estimate;
  };
  const fcl::Sphered ball(0.2);
  auto cells = std::make_shared<octomap::OcTree>(0.1);
  cells->updateNode(2.05, 0.05, 0.05, true);
  const fcl::OcTreed octree{std::shared_ptr<const octomap::OcTree>(cells)};

  CHECK(probability(*inner, at(2, 0, 0), *outer, kIdentity) == 0.0);
  CHECK(probability(ball, at(2, 0, 0), *outer, kIdentity) == 0.0);
  request.contact = ContactMeaning::solid;
  CHECK(probability(*inner, at(2, 0, 0), *outer, kIdentity) == 1.0);
  CHECK(probability(*outer, kIdentity, *inner, at(2, 0, 0)) == 1.0);
  CHECK(probability(*inner, kIdentity, *outer, kIdentity) == 0.0);  // in the hole of the torus
  CHECK(probability(ball, at(2, 0, 0), *outer, kIdentity) == 1.0);
  CHECK(probability(*outer, at(-2, 0, 0), ball, kIdentity) == 1.0);
  CHECK(probability(ball, kIdentity, *outer, kIdentity) == 0.0);
  CHECK(probability(octree, kIdentity, *outer, kIdentity) == 1.0);
  CHECK(probability(*outer, at(2, 0, 0), octree, kIdentity) == 0.0);

  TriangleMesh open = sphereMesh(0.2, 6, 8);
  open.triangles.pop_back();
  const auto hole = makeModel<fcl::OBBRSSd>(open);
  CHECK_THROWS_AS(probability(*hole, kIdentity, *outer, kIdentity), OpenMesh);
  CHECK_THROWS_AS(probability(*outer, kIdentity, *hole, kIdentity), OpenMesh);
}

TEST_CASE("the gradient agrees with the derivative of the box probability") {
  const Eigen::Vector3d sides(1, 1, 1), sigma(0.5, 0.4, 0.6), offset(1.2, 0.8, 0.3);
  const fcl::Boxd a(sides), b(sides);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()));
  const auto displacement = GaussianDisplacement::fromStandardDeviations(sigma, turn);
  fcl::Transform3d pose_a(turn), pose_b(turn);
  pose_b.translation() = turn * offset;
  ProbabilityRequest request = requestOf(40000);
  request.gradient = true;
  const auto result = monteCarloProbability(a, pose_a, b, pose_b, displacement, request);
  Eigen::Vector3d expected;
  const double h = 1e-5;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
    expected[k] = (boxProbability(sides, sides, offset - step, sigma) -
                   boxProbability(sides, sides, offset + step, sigma)) /
                  (2 * h);
  }
  expected = turn * expected;
  REQUIRE(result.gradient);
  for (int k = 0; k < 3; ++k) {
    CHECK(std::abs((*result.gradient)[k] - expected[k]) < 4 * (*result.gradient_standard_error)[k]);
    CHECK((*result.gradient_standard_error)[k] < 0.05 * expected.norm());
  }
}

TEST_CASE("gradients of few samples are within their errors, from rare contact to sure one") {
  const Eigen::Vector3d sides(1, 1, 1), sigma(0.5, 0.4, 0.6);
  const fcl::Boxd box(sides);
  const auto displacement = GaussianDisplacement::fromStandardDeviations(sigma);
  for (const double along : {-2.0, 0.0, 0.3, 1.0, 1.8, 2.4, 3.2, 4.0}) {
    const Eigen::Vector3d offset(along, 0.3, 0.1);
    Eigen::Vector3d expected;
    const double h = 1e-4;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
      expected[k] = (boxProbability(sides, sides, offset - step, sigma) -
                     boxProbability(sides, sides, offset + step, sigma)) /
                    (2 * h);
    }
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      ProbabilityRequest request = requestOf(200);
      request.seed = seed;
      request.gradient = true;
      const auto result =
          monteCarloProbability(box, kIdentity, box, at(offset), displacement, request);
      CAPTURE(along, seed, result.statistics.hits, *result.gradient, expected,
              *result.gradient_standard_error);
      const Eigen::Array3d off = (*result.gradient - expected).array().abs();
      CHECK((off < 6 * result.gradient_standard_error->array()).all());
    }
  }
}

TEST_CASE("a run stops at its tolerance, its threshold, its time or when it is told to") {
  const fcl::Boxd a(1, 1, 1), b(1, 1, 1);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.5, 0.5, 0.5});
  const auto run = [&](const ProbabilityRequest& request) {
    return monteCarloProbability(a, kIdentity, b, at(1, 0, 0), displacement, request);
  };
  ProbabilityRequest request = requestOf(1000000);
  request.absolute_tolerance = 0.05;
  const auto coarse = run(request);
  CHECK(coarse.status == ProbabilityStatus::converged);
  CHECK(coarse.statistics.samples < 10000);
  CHECK(0.5 * coarse.confidence_interval->width() <= 0.05);

  request = requestOf(1000000);
  request.threshold = 0.9;
  const auto decided = run(request);
  CHECK(decided.status == ProbabilityStatus::decided);
  CHECK(decided.decision == Decision::below);
  CHECK(decided.statistics.samples == 1024);
  request.threshold = 0.1;
  CHECK(run(request).decision == Decision::above);
  request = requestOf(50);
  request.threshold = 0.45;
  CHECK(run(request).decision == Decision::undecided);

  request = requestOf(100000000);
  request.time_limit = 0.02;
  const auto timed = run(request);
  CHECK(timed.status == ProbabilityStatus::time_limit);
  CHECK(timed.statistics.samples > 0);
  CHECK(timed.statistics.samples < 100000000);

  request = requestOf(100000000);
  int calls = 0;
  double last_fraction = 0;
  request.on_progress = [&](const ProbabilityProgress& progress) {
    CHECK(progress.fraction > last_fraction);
    CHECK(progress.interval.contains(0.45));
    last_fraction = progress.fraction;
    return ++calls < 3;
  };
  const auto cancelled = run(request);
  CHECK(cancelled.status == ProbabilityStatus::cancelled);
  CHECK(calls == 3);
}

TEST_CASE("inputs of a run are checked before any work") {
  const fcl::Boxd box(1, 1, 1), flat(1, 0, 1);
  const GaussianDisplacement displacement;
  fcl::Transform3d skewed = kIdentity;
  skewed.linear()(0, 1) = 0.1;
  CHECK_THROWS_AS(monteCarloProbability(flat, kIdentity, box, kIdentity, displacement, {}),
                  InvalidGeometry);
  CHECK_THROWS_AS(monteCarloProbability(box, skewed, box, kIdentity, displacement, {}),
                  InvalidPose);
  ProbabilityRequest request;
  request.samples = 0;
  CHECK_THROWS_AS(monteCarloProbability(box, kIdentity, box, kIdentity, displacement, request),
                  InvalidRequest);
}
