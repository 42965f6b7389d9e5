// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The estimate: unbiased, and off by as much as its standard error says.
#include <cmath>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "mesh_shapes.h"
#include "partition_query.h"

namespace {

using fcl_prob::GaussianDisplacement;
using fcl_prob::ProbabilityMethod;
using fcl_prob::ProbabilityRequest;
using fcl_prob::ProbabilityResult;
using fcl_prob_test::PartitionQuery;

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

TEST_CASE("an estimate whose time is up still has its samples and a valid interval") {
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
  CHECK(result.statistics.samples >= 8 * result.statistics.cells_open);
  CHECK(*result.estimate >= *result.lower);
  CHECK(*result.estimate <= *result.upper);
}
