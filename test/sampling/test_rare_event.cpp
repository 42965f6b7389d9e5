// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>

#include "benchmark_scenes.h"
#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/monte_carlo.h"
#include "fcl_prob/normal_mass.h"
#include "mesh_shapes.h"
#include "poses.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

ProbabilityRequest rareRequest(std::size_t samples) {
  ProbabilityRequest request;
  request.samples = samples;
  request.relative_tolerance = 1e-9;
  return request;
}

struct BoxScene {
  std::string name;
  Eigen::Vector3d sides_a, sides_b, offset, sigma;
  double largest_error;  // relative standard error that 10,000 samples must reach

  double probability() const {
    const Eigen::Vector3d half = 0.5 * (sides_a + sides_b);
    return normalBoxMass((offset - half).cwiseQuotient(sigma),
                         (offset + half).cwiseQuotient(sigma));
  }
};

const Eigen::Vector3d kOne(1, 1, 1);

std::vector<BoxScene> boxScenes() {
  return {{"1e-8", kOne, kOne, {1.56, 0, 0}, {0.1, 0.1, 0.1}, 0.01},
          {"1e-12", kOne, kOne, {1.7, 0, 0}, {0.1, 0.1, 0.1}, 0.01},
          {"1e-98", kOne, kOne, {3.1, 0, 0}, {0.1, 0.1, 0.1}, 0.01},
          {"corner to corner", kOne, kOne, {1.35, 1.35, 1.35}, {0.1, 0.1, 0.1}, 0.03},
          {"anisotropic", kOne, kOne, {1.07, 1.3, 1.2}, {0.01, 0.1, 0.05}, 0.04},
          {"small", 0.01 * kOne, 0.01 * kOne, {0.5, 0.2, 0.1}, {0.1, 0.1, 0.1}, 0.02},
          {"tiny", 1e-3 * kOne, 1e-4 * kOne, {0.5, 0.2, 0.1}, {0.1, 0.1, 0.1}, 0.02},
          {"rod", {3, 0.01, 0.01}, {0.01, 0.01, 0.01}, {1, 0.4, 0.4}, {0.1, 0.1, 0.1}, 0.02},
          {"plate", {3, 3, 1e-3}, 1e-3 * kOne, {0, 0, 0.6}, {0.1, 0.1, 0.1}, 0.01},
          {"not rare", kOne, kOne, {1.1, 0, 0}, {0.1, 0.1, 0.1}, 0.01},
          {"certain", kOne, kOne, {0.1, 0, 0}, {0.1, 0.1, 0.1}, 0.01}};
}

void checkClose(const ProbabilityResult& result, double expected, double largest_error) {
  INFO("estimate " << *result.estimate << " +- " << *result.standard_error << ", expected "
                   << expected);
  CHECK(std::abs(*result.estimate - expected) <= 4 * *result.standard_error + 1e-12 * expected);
  CHECK(*result.standard_error <= largest_error * expected);
}

}  // namespace

TEST_CASE("rare events agree with the box probability, from certain to 1e-98") {
  for (const BoxScene& scene : boxScenes()) {
    INFO(scene.name);
    const auto displacement = GaussianDisplacement::fromStandardDeviations(scene.sigma);
    const fcl::Boxd a(scene.sides_a), b(scene.sides_b);
    checkClose(
        rareEventProbability(a, kIdentity, b, at(scene.offset), displacement, rareRequest(10000)),
        scene.probability(), scene.largest_error);
  }
  CHECK(boxScenes()[0].probability() == Approx(1.07e-8).epsilon(0.01));
  CHECK(boxScenes()[1].probability() == Approx(1.28e-12).epsilon(0.01));
}

TEST_CASE("rare events of meshes agree with the box probability at 1e-8 and 1e-12") {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  const fcl::Transform3d world(turn);
  for (const BoxScene& scene : {boxScenes()[0], boxScenes()[1], boxScenes()[3]}) {
    INFO(scene.name);
    const Eigen::Vector3d mean(0.3, -0.2, 0.1);
    const auto displacement =
        GaussianDisplacement::fromStandardDeviations(scene.sigma, turn, turn * mean);
    const auto a = makeModel<fcl::OBBRSSd>(boxMesh(scene.sides_a));
    const auto b = makeModel<fcl::OBBRSSd>(boxMesh(scene.sides_b));
    checkClose(rareEventProbability(*a, world, *b, world * at(scene.offset + mean), displacement,
                                    rareRequest(10000)),
               scene.probability(), scene.largest_error);
  }
}

TEST_CASE("a gradient is told with an error or not at all") {
  const fcl::Boxd box(1.0, 1.0, 1.0);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  fcl::Transform3d beside = fcl::Transform3d::Identity();
  beside.translation().x() = 1.1;
  for (const std::size_t samples : {1, 2, 10}) {
    ProbabilityRequest request = rareRequest(samples);
    request.gradient = true;
    for (const ProbabilityResult& result :
         {rareEventProbability(box, fcl::Transform3d::Identity(), box, beside, displacement,
                               request),
          monteCarloProbability(box, fcl::Transform3d::Identity(), box, beside, displacement,
                                request)}) {
      CHECK(result.gradient.has_value() == result.gradient_standard_error.has_value());
      if (result.gradient) CHECK(result.gradient_standard_error->allFinite());
      if (samples == 1) CHECK_FALSE(result.gradient);
    }
  }
}

TEST_CASE("both sides of an obstacle are found") {
  const auto a = makeModel<fcl::OBBRSSd>(boxMesh(kOne));
  const auto b = makeModel<fcl::OBBRSSd>(joined(transformed(boxMesh(kOne), at({1.6, 0, 0})),
                                                transformed(boxMesh(kOne), at({-1.62, 0, 0}))));
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  checkClose(rareEventProbability(*a, kIdentity, *b, kIdentity, displacement, rareRequest(10000)),
             normalTailMass(6.0) + normalTailMass(6.2), 0.01);
}

TEST_CASE("round, unbounded and voxel shapes") {
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  const fcl::Boxd box(1, 1, 1);
  const auto run = [&](const fcl::CollisionGeometryd& b, const Eigen::Vector3d& offset) {
    return rareEventProbability(box, kIdentity, b, at(offset), displacement, rareRequest(10000));
  };
  checkClose(run(fcl::Halfspaced(0, 0, 1, -1.1), {5, 6, 0}), normalTailMass(6), 0.01);
  checkClose(run(fcl::Planed(0, 0, 1, -1.1), {5, 6, 0}), normalTailMass(6) - normalTailMass(16),
             0.01);
  checkClose(rareEventProbability(fcl::Halfspaced(0, 0, 1, -1.1), kIdentity, box, kIdentity,
                                  displacement, rareRequest(10000)),
             normalTailMass(6), 0.01);
  // A ball of two standard deviations, eight away: Φ(-6) - Φ(-10) - (φ(6) - φ(10)) / 8.
  const double inverse_root = 0.39894228040143268;
  const double ball = normalTailMass(6) - normalTailMass(10) -
                      inverse_root * (std::exp(-18.0) - std::exp(-50.0)) / 8;
  checkClose(rareEventProbability(fcl::Sphered(0.1), kIdentity, fcl::Sphered(0.1), at({0.8, 0, 0}),
                                  displacement, rareRequest(10000)),
             ball, 0.02);

  auto tree = std::make_shared<octomap::OcTree>(0.5);
  tree->updateNode(0.25, 0.25, 0.25, true);
  const fcl::OcTreed octree{std::shared_ptr<const octomap::OcTree>(tree)};
  checkClose(run(octree, {1.1, -0.25, -0.25}), normalBoxMass({6, -7.5, -7.5}, {21, 7.5, 7.5}),
             0.01);
}

TEST_CASE("displacements along a plane or a line") {
  const fcl::Boxd box(1, 1, 1);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.6, Eigen::Vector3d(3, 1, 2).normalized()));
  const fcl::Transform3d world(turn);
  const auto run = [&](const Eigen::Vector3d& sigma, const Eigen::Vector3d& offset) {
    return rareEventProbability(box, world, box, world * at(offset),
                                GaussianDisplacement::fromStandardDeviations(sigma, turn),
                                rareRequest(10000));
  };
  checkClose(run({0.1, 0.1, 0}, {1.6, 0.3, 0.4}), normalTailMass(6), 0.01);
  checkClose(run({0, 0.1, 0}, {0.3, -1.6, 0.4}), normalTailMass(6), 0.01);
  const ProbabilityResult beside = run({0.1, 0, 0}, {1.6, 1.2, 0});
  CHECK(*beside.estimate == 0.0);
  CHECK(beside.status == ProbabilityStatus::exact);
  CHECK(beside.confidence_interval->upper == 0.0);
  CHECK_THROWS_AS(run({0, 0, 0}, {1.6, 0, 0}), InvalidRequest);
}

TEST_CASE("a solid within another is not rare") {
  const auto outer = makeModel<fcl::OBBRSSd>(sphereMesh(2, 12, 16));
  const auto inner = makeModel<fcl::OBBRSSd>(sphereMesh(0.2, 6, 8));
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  ProbabilityRequest request = rareRequest(4000);
  CHECK(
      *rareEventProbability(*inner, kIdentity, *outer, kIdentity, displacement, request).estimate <
      1e-50);
  request.contact = ContactMeaning::solid;
  checkClose(rareEventProbability(*inner, kIdentity, *outer, kIdentity, displacement, request), 1.0,
             0.02);
  const fcl::Sphered ball(2.0);  // solid by itself
  request.contact = ContactMeaning::fcl;
  checkClose(rareEventProbability(*inner, kIdentity, ball, kIdentity, displacement, request), 1.0,
             0.02);
}

TEST_CASE("the confidence interval covers") {
  const fcl::Boxd a(1, 1, 1), b(1, 1, 1);
  const auto corner = boxScenes()[3];
  const auto displacement = GaussianDisplacement::fromStandardDeviations(corner.sigma);
  ProbabilityRequest request = rareRequest(1500);
  request.confidence = 0.9;
  int covered = 0;
  double width = 0.0;
  const int runs = 200;
  for (int run = 0; run < runs; ++run) {
    request.seed = static_cast<std::uint64_t>(run + 1);
    const auto result =
        rareEventProbability(a, kIdentity, b, at(corner.offset), displacement, request);
    covered += result.confidence_interval->contains(corner.probability());
    width += result.confidence_interval->width() / corner.probability() / runs;
  }
  INFO(covered << " of " << runs << " intervals cover, mean relative width " << width);
  CHECK(covered >= 0.9 * runs);
  CHECK(width < 2.0);
}

TEST_CASE("a scene of real meshes agrees with plain sampling where that can reach") {
  const auto scene = benchmarkSceneOrSkip("bunny_5cm");
  if (!scene) return;
  const auto a = makeModel<fcl::OBBRSSd>(scene->a);
  const auto b = makeModel<fcl::OBBRSSd>(scene->b);
  const auto result = rareEventProbability(*a, scene->pose_a, *b, scene->pose_b,
                                           scene->displacement, rareRequest(5000));
  checkClose(result, scene->estimate, 0.02);
  CHECK(*result.statistics.effective_samples > 500);
  CHECK(result.confidence_interval->contains(scene->estimate));
}

TEST_CASE("rare events do not depend on the number of threads") {
  const auto a = makeModel<fcl::OBBRSSd>(bumpyMesh(1, 8, 12, 1));
  const auto b = makeModel<fcl::OBBRSSd>(bumpyMesh(1, 8, 12, 2));
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.06, 0.08});
  ProbabilityRequest request = rareRequest(3000);
  request.gradient = true;
  const auto one = rareEventProbability(*a, kIdentity, *b, at({2.6, 0, 0}), displacement, request);
  REQUIRE(*one.estimate > 0.0);
  REQUIRE(*one.estimate < 1e-3);
  request.threads = 2;
  const auto two = rareEventProbability(*a, kIdentity, *b, at({2.6, 0, 0}), displacement, request);
  CHECK(*one.estimate == *two.estimate);
  CHECK(*one.gradient == *two.gradient);
  CHECK(one.statistics.hits == two.statistics.hits);
}

TEST_CASE("the gradient of a rare event") {
  const fcl::Boxd box(1, 1, 1);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()));
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1}, turn);
  ProbabilityRequest request = rareRequest(10000);
  request.gradient = true;
  const auto result =
      rareEventProbability(box, kIdentity, box, at({1.6, 0, 0}), displacement, request);
  const double slope = 0.39894228040143268 * std::exp(-18.0) / 0.1;  // φ(6) / σ
  REQUIRE(result.gradient);
  CHECK(std::abs((*result.gradient)[0] - slope) < 4 * (*result.gradient_standard_error)[0]);
  CHECK((*result.gradient_standard_error)[0] < 0.02 * slope);
  CHECK(std::abs((*result.gradient)[1]) < 4 * (*result.gradient_standard_error)[1]);

  // Few samples know it badly, and say so.
  for (const double deviations : {1.0, 3.0, 6.0}) {
    const double expected = 0.39894228040143268 * std::exp(-0.5 * deviations * deviations) / 0.1;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      request = rareRequest(100);
      request.seed = seed;
      request.gradient = true;
      const auto few = rareEventProbability(box, kIdentity, box, at({1.0 + 0.1 * deviations, 0, 0}),
                                            displacement, request);
      CAPTURE(deviations, seed, few.statistics.hits, *few.gradient, expected,
              *few.gradient_standard_error);
      const Eigen::Array3d off =
          (*few.gradient - expected * Eigen::Vector3d::UnitX()).array().abs();
      CHECK((off < 6 * few.gradient_standard_error->array()).all());
    }
  }
}
