// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The estimate: off by as much as its standard error says.
#include <fcl/narrowphase/collision.h>

#include <cmath>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "mesh_shapes.h"
#include "partition_query.h"
#include "random_bodies.h"

namespace {

using fcl_prob::GaussianDisplacement;
using fcl_prob::ProbabilityMethod;
using fcl_prob::ProbabilityRequest;
using fcl_prob::ProbabilityResult;
using fcl_prob_test::PartitionQuery;
using fcl_prob_test::RandomBodies;

/// How far estimates with different seeds are from the truth, in their standard errors.
struct Coverage {
  double mean = 0.0;
  double mean_square = 0.0;
  int beyond_three = 0;
};

constexpr int kSeeds = 150;

Coverage coverageOf(const PartitionQuery& query, const GaussianDisplacement& displacement,
                    double relative_tolerance, double truth) {
  Coverage coverage;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    ProbabilityRequest request;
    request.method = ProbabilityMethod::estimate;
    request.absolute_tolerance = 0.0;
    request.relative_tolerance = relative_tolerance;
    request.seed = static_cast<std::uint64_t>(seed);
    const ProbabilityResult result = query.run(displacement, request);
    REQUIRE(*result.standard_error <= relative_tolerance * *result.estimate);
    REQUIRE(*result.standard_error > 0.0);
    const double off = (*result.estimate - truth) / *result.standard_error;
    coverage.mean += off / kSeeds;
    coverage.mean_square += off * off / kSeeds;
    coverage.beyond_three += std::fabs(off) > 3.0;
  }
  return coverage;
}

}  // namespace

TEST_CASE("estimates with many seeds scatter around P as their standard errors say", "[slow]") {
  PartitionQuery query(fcl_prob_test::bumpyMesh(0.5, 12, 20, 3),
                       fcl_prob_test::bumpyMesh(0.7, 14, 22, 4));
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.15});
  for (const double distance : {1.1, 1.4, 1.7}) {
    query.pose_a.translation() = Eigen::Vector3d(distance, 0.1, -0.2);
    const ProbabilityResult interval =
        query.run(displacement, fcl_prob_test::intervalRequest(5e-4));
    REQUIRE(*interval.lower > 1e-4);
    const double truth = interval.probability();
    const Coverage coverage = coverageOf(query, displacement, 0.01, truth);
    CAPTURE(distance, truth, coverage.mean, coverage.mean_square, coverage.beyond_three);
    // Mean 0 and variance 1 but for what the choice of the stopping point adds.
    CHECK(std::fabs(coverage.mean) < 0.4);
    CHECK(coverage.mean_square > 0.5);
    CHECK(coverage.mean_square < 1.7);
    CHECK(coverage.beyond_three <= 5);
  }
}

TEST_CASE("an estimate of a probability below the least double ends at once") {
  PartitionQuery query(fcl_prob_test::boxMesh({1, 1, 1}), fcl_prob_test::boxMesh({1, 1, 1}));
  ProbabilityRequest request;
  request.method = ProbabilityMethod::estimate;
  request.absolute_tolerance = 0.0;
  request.max_cells = 20'000;
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  for (const double distance : {4.7, 4.8, 4.85, 4.9, 5.0, 6.0}) {
    query.pose_a.translation() = Eigen::Vector3d(distance, 0.0, 0.0);
    for (const double tolerance : {0.01, 1e-9}) {
      request.relative_tolerance = tolerance;
      const ProbabilityResult result = query.run(displacement, request);
      CAPTURE(distance, tolerance, *result.upper);
      CHECK(result.statistics.cells < 20'000);
      CHECK(*result.upper < 1e-290);
      CHECK(*result.estimate >= 0.0);
    }
  }
}

TEST_CASE("an estimate whose time is up says how little it knows, and has a valid interval") {
  PartitionQuery query(fcl_prob_test::bumpyMesh(0.5, 12, 20, 3),
                       fcl_prob_test::bumpyMesh(0.7, 14, 22, 4));
  query.pose_a.translation() = Eigen::Vector3d(1.4, 0.1, -0.2);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.15});
  const ProbabilityResult truth = query.run(displacement, fcl_prob_test::intervalRequest(0.01));
  ProbabilityRequest request;
  request.method = ProbabilityMethod::estimate;
  request.absolute_tolerance = 0.0;
  request.relative_tolerance = 1e-9;
  request.time_limit = 0.02;
  const ProbabilityResult result = query.run(displacement, request);
  CHECK(result.status == fcl_prob::ProbabilityStatus::time_limit);
  CHECK(*result.lower <= *truth.upper);
  CHECK(*result.upper >= *truth.lower);
  CHECK(std::fabs(*result.estimate - truth.probability()) <=
        5 * *result.standard_error + (*truth.upper - *truth.lower));
  CHECK(*result.estimate >= *result.lower);
  CHECK(*result.estimate <= *result.upper);
}

namespace {

/// Frequency of contact among displacements that are drawn directly.
double collidingShare(const PartitionQuery& query, const GaussianDisplacement& displacement,
                      int samples, RandomBodies& random) {
  const Eigen::Matrix3d factor =
      displacement.axes() * displacement.standardDeviations().asDiagonal();
  int hits = 0;
  for (int i = 0; i < samples; ++i) {
    fcl::Transform3d pose = query.pose_a;
    pose.pretranslate(factor * random.normalVector());
    fcl::CollisionResultd collision;
    fcl::collide(query.model_a.get(), pose, query.model_b.get(), query.pose_b,
                 fcl::CollisionRequestd(), collision);
    hits += collision.isCollision();
  }
  return static_cast<double>(hits) / samples;
}

/// Standard deviations of which one matters and the others are anything down to none.
Eigen::Vector3d stretchedDeviations(RandomBodies& random) {
  Eigen::Vector3d deviations(random.logUniform(0.03, 0.6), 0.0, 0.0);
  for (int k = 1; k < 3; ++k) {
    if (random.uniform(0, 1) < 0.8) deviations[k] = random.logUniform(1e-12, 1.0);
  }
  return deviations;
}

}  // namespace

TEST_CASE("estimates are as good where whitening stretches the objects", "[estimate]") {
  PartitionQuery query(fcl_prob_test::bumpyMesh(0.5, 8, 12, 3),
                       fcl_prob_test::bumpyMesh(0.7, 8, 12, 4));
  RandomBodies random(21);
  constexpr int kSamples = 1500;
  ProbabilityRequest request;
  request.method = ProbabilityMethod::estimate;
  request.relative_tolerance = 0.03;
  request.max_cells = 3000;
  int between = 0, narrow = 0;
  for (int i = 0; i < 60; ++i) {
    query.pose_a.linear() = random.rotation();
    query.pose_b.linear() = random.rotation();
    query.pose_b.translation() = random.uniform(0.6, 1.5) * random.direction();
    const auto displacement = GaussianDisplacement::fromStandardDeviations(
        stretchedDeviations(random), Eigen::Quaterniond(random.rotation()));
    const ProbabilityResult result = query.run(displacement, request);
    const double share = collidingShare(query, displacement, kSamples, random);
    const double p = *result.estimate;
    const double error = std::hypot(*result.standard_error, std::sqrt(p * (1 - p) / kSamples));
    INFO("scene " << i << " sigma " << displacement.standardDeviations().transpose());
    INFO(p << " +- " << *result.standard_error << " sampled " << share);
    CHECK(std::fabs(p - share) <= 5 * error + 4.0 / kSamples);
    CHECK(share >= *result.lower - 5 * error - 4.0 / kSamples);
    CHECK(share <= *result.upper + 5 * error + 4.0 / kSamples);
    between += share > 0.01 && share < 0.99;
    narrow += *result.standard_error <= request.relative_tolerance * p;
  }
  CHECK(between > 25);
  CHECK(narrow > 50);
}
