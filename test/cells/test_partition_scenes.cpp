// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The certified interval on the six benchmark scenes.
#include <cmath>

#include "benchmark_scenes.h"
#include "catch.h"
#include "query/partition.h"

namespace {

using fcl_prob::Bounds;
using fcl_prob::ProbabilityRequest;
using fcl_prob::ProbabilityResult;

struct SceneQuery {
  explicit SceneQuery(const fcl_prob_test::BenchmarkScene& scene_in)
      : scene(scene_in),
        model_a(fcl_prob_test::makeModel<fcl::OBBRSSd>(scene.a)),
        model_b(fcl_prob_test::makeModel<fcl::OBBRSSd>(scene.b)),
        a(fcl_prob::detail::buildPieceTree(*model_a)),
        b(fcl_prob::detail::buildPieceTree(*model_b)) {}

  ProbabilityResult run(const ProbabilityRequest& request) const {
    return fcl_prob::detail::partitionProbability({a.get(), {{scene.pose_a, nullptr}}},
                                                  {b.get(), {{scene.pose_b, nullptr}}},
                                                  scene.displacement, request);
  }

  fcl_prob_test::BenchmarkScene scene;
  std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> model_a, model_b;
  std::shared_ptr<const fcl_prob::detail::PieceTree> a, b;
};

// Both intervals hold P, so they must overlap.
bool overlap(const Bounds& x, const Bounds& y) { return x.lower <= y.upper && y.lower <= x.upper; }

}  // namespace

TEST_CASE("the interval holds P on the benchmark scenes at every step and tolerance",
          "[scenes][slow]") {
  for (const std::string& name : fcl_prob_test::benchmarkSceneNames()) {
    const auto scene = fcl_prob_test::benchmarkSceneOrSkip(name);
    if (!scene) continue;
    INFO(name);
    const SceneQuery query(*scene);
    for (const double tolerance : {0.1, 0.02}) {
      ProbabilityRequest request;
      request.absolute_tolerance = 0.0;
      request.relative_tolerance = tolerance;
      std::size_t steps = 0;
      Bounds before{0.0, 1.0};
      request.on_progress = [&](const fcl_prob::ProbabilityProgress& progress) {
        ++steps;
        CHECK(overlap(progress.interval, scene->reference));
        CHECK(progress.interval.lower >= before.lower * (1 - 1e-9));
        before = progress.interval;
        return true;
      };
      const ProbabilityResult result = query.run(request);
      CHECK(result.status == fcl_prob::ProbabilityStatus::converged);
      CHECK(overlap({*result.lower, *result.upper}, scene->reference));
      CHECK(*result.upper - *result.lower <= tolerance * *result.upper);
      CHECK(steps > 1);
    }
  }
}

TEST_CASE("the estimate is within its standard error of P on the benchmark scenes", "[scenes]") {
  for (const std::string& name : fcl_prob_test::benchmarkSceneNames()) {
    const auto scene = fcl_prob_test::benchmarkSceneOrSkip(name);
    if (!scene) continue;
    INFO(name);
    const SceneQuery query(*scene);
    ProbabilityRequest request;
    request.method = fcl_prob::ProbabilityMethod::estimate;
    request.absolute_tolerance = 0.0;
    request.relative_tolerance = 0.01;
    const ProbabilityResult result = query.run(request);
    CHECK(*result.standard_error <= 0.01 * *result.estimate);
    CHECK(std::fabs(*result.estimate - scene->estimate) <= 5 * *result.standard_error);
    CHECK(overlap({*result.lower, *result.upper}, scene->reference));
  }
}

TEST_CASE("a threshold is decided with fewer cells than a tolerance takes", "[scenes]") {
  const auto scene = fcl_prob_test::benchmarkSceneOrSkip("bunny_5cm");
  if (!scene) return;
  const SceneQuery query(*scene);
  ProbabilityRequest request;
  request.absolute_tolerance = 0.0;
  request.threshold = 0.05;
  const ProbabilityResult above = query.run(request);
  CHECK(above.decision == fcl_prob::Decision::above);
  CHECK(above.status == fcl_prob::ProbabilityStatus::decided);
  request.threshold = 0.2;
  const ProbabilityResult below = query.run(request);
  CHECK(below.decision == fcl_prob::Decision::below);
  request.threshold.reset();
  CHECK(above.statistics.cells * 2 < query.run(request).statistics.cells);
}
