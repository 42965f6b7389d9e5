// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The gradient against central differences of P, on curved meshes.
#include "catch.h"
#include "partition_query.h"
#include "random_bodies.h"

namespace {

using fcl_prob::GaussianDisplacement;
using fcl_prob::ProbabilityResult;
using fcl_prob_test::intervalRequest;
using fcl_prob_test::PartitionQuery;

void checkDifferences(int scenes, unsigned seed) {
  fcl_prob_test::RandomBodies random(seed);
  int tested = 0;
  for (int i = 0; i < scenes; ++i) {
    PartitionQuery query(fcl_prob_test::bumpyMesh(0.5, 4, 6, static_cast<std::uint64_t>(i)),
                         fcl_prob_test::torusMesh(0.6, 0.2, 7, 4));
    query.pose_a.linear() = random.rotation();
    query.pose_b.linear() = random.rotation();
    query.pose_b.translation() = random.uniform(0.9, 1.5) * random.direction();
    const Eigen::Vector3d sigma(random.logUniform(0.05, 0.4), random.logUniform(0.05, 0.4),
                                random.logUniform(0.05, 0.4));
    const auto displacement =
        GaussianDisplacement::fromStandardDeviations(sigma, random.quaternion());
    auto request = intervalRequest(1e-3);
    request.gradient = true;
    const ProbabilityResult result = query.run(displacement, request);
    const Eigen::Vector3d direction = result.gradient->normalized();
    // A step at which neither the intervals' width nor the curvature of P matters.
    const double step = 0.5 * sigma.minCoeff();
    request = intervalRequest(5e-4);
    const auto at = [&](double along) {
      const ProbabilityResult moved = query.run(displacement.withMean(along * direction), request);
      return 0.5 * (*moved.lower + *moved.upper);
    };
    const double slope =
        (8 * (at(0.5 * step) - at(-0.5 * step)) - (at(step) - at(-step))) / (6 * step);
    if (result.probability() < 1e-3) continue;  // a tail bends too much for these steps
    INFO("scene " << i << ", P " << result.probability() << ", slope " << slope);
    if (result.gradient->norm() * step < 0.02 * result.probability())
      continue;  // differences drown
    CHECK(std::fabs(result.gradient->norm() - slope) <= 0.01 * slope);
    ++tested;
  }
  CHECK(2 * tested >= scenes);
}

}  // namespace

TEST_CASE("the gradient agrees with central differences on random scenes", "[gradient][slow]") {
  checkDifferences(7, 3);
}

TEST_CASE("the gradient agrees with central differences on 40 scenes", "[gradient][long]") {
  checkDifferences(40, 4);
}
