// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Thresholds told by random lines: against certified intervals, wrong no more often than stated.
#include "lines/line_bets.h"

#include <cmath>

#include "catch.h"
#include "dented_mesh.h"
#include "partition_query.h"

namespace {

using fcl_prob::GaussianDisplacement;
using fcl_prob::ProbabilityRequest;
using fcl_prob::ProbabilityResult;
using fcl_prob::TriangleMesh;
using namespace fcl_prob::detail;
using fcl_prob_test::bumpyMesh;
using fcl_prob_test::hullMesh;
using fcl_prob_test::PartitionQuery;
using fcl_prob_test::RandomBodies;

struct Told {
  int below = 0, above = 0, open = 0;
  int outside = 0;  ///< intervals without P
};

/// What lines tell of a threshold, with many seeds.
Told toldOf(const PartitionQuery& query, const GaussianDisplacement& displacement, double threshold,
            const fcl_prob::Bounds& truth, double error, int seeds) {
  Told told;
  const PartitionObject a = query.a(), b = query.b();
  for (int seed = 1; seed <= seeds; ++seed) {
    ProbabilityRequest request;
    request.seed = static_cast<std::uint64_t>(seed);
    const auto bets = LineBets::of(a, b, displacement, request, error);
    REQUIRE(bets);
    const auto isOpen = [&] {
      return bets->probable().lower <= threshold && bets->probable().upper >= threshold;
    };
    while (isOpen() && bets->improve(bets->likely() > threshold, threshold)) {
    }
    told.open += isOpen();
    told.below += bets->probable().upper < threshold;
    told.above += bets->probable().lower > threshold;
    told.outside += bets->probable().upper < truth.lower || bets->probable().lower > truth.upper;
    CHECK(bets->certified().lower <= truth.upper);
    CHECK(bets->certified().upper >= truth.lower);
  }
  return told;
}

}  // namespace

TEST_CASE("lines tell thresholds, wrong no more often than stated", "[lines][slow]") {
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.15});
  constexpr double kError = 0.1;
  constexpr int kSeeds = 20;
  RandomBodies random(8);
  int told_below = 0, told_above = 0, wrong = 0, outside = 0, all = 0;
  for (int scene = 0; scene < 16; ++scene) {
    TriangleMesh body = hullMesh(random.onSphere(random.integer(10, 100), 0.5));
    const bool is_dented = scene % 4 == 3;
    if (is_dented) body = fcl_prob_test::withDents(body, 2, 1e-3, random);
    PartitionQuery query(body, bumpyMesh(0.7, 12, 16, static_cast<std::uint64_t>(scene)));
    query.pose_a.linear() = random.rotation();
    query.pose_a.translation() = random.uniform(1.1, 1.5) * random.direction();
    if (scene % 3 == 0) query.makeSolid();
    const ProbabilityResult result = query.run(displacement, fcl_prob_test::intervalRequest(3e-3));
    const fcl_prob::Bounds truth{*result.lower, *result.upper};
    for (const double factor : {0.9, 0.98, 1.02, 1.1}) {
      const double threshold = factor * (factor < 1.0 ? truth.lower : truth.upper);
      const Told told = toldOf(query, displacement, threshold, truth, kError, kSeeds);
      CAPTURE(scene, factor, truth.lower, truth.upper, told.below, told.above, told.open);
      wrong += factor < 1.0 ? told.below : told.above;
      told_below += told.below;
      told_above += told.above;
      outside += told.outside;
      all += kSeeds;
    }
  }
  CAPTURE(told_below, told_above, wrong, outside, all);
  CHECK(told_below + told_above > 0.8 * all);
  CHECK(told_below > 0.3 * all);
  CHECK(told_above > 0.3 * all);
  const double most = kError * all + 4.0 * std::sqrt(kError * all);
  CHECK(wrong <= most);
  CHECK(outside <= most);
}

TEST_CASE("nothing is told by lines where no object can be taken whole", "[lines]") {
  const TriangleMesh bumpy = bumpyMesh(0.7, 12, 16, 1);
  PartitionQuery query(bumpy, bumpy);
  query.pose_a.translation() = Eigen::Vector3d(1.4, 0.0, 0.0);
  const PartitionObject a = query.a(), b = query.b();
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.15});
  CHECK_FALSE(LineBets::of(a, b, displacement, {}, 0.1));
}
