// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Every method on the benchmark scenes, through the public interface.
#include "benchmark_scenes.h"
#include "catch.h"
#include "fcl_prob/fcl_prob.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

bool certified(ProbabilityMethod method) {
  return method != ProbabilityMethod::monte_carlo && method != ProbabilityMethod::rare_event;
}

}  // namespace

TEST_CASE("every method agrees with the reference of the benchmark scenes", "[slow]") {
  for (const std::string& name : benchmarkSceneNames()) {
    const auto scene = benchmarkSceneOrSkip(name);
    if (!scene) return;
    const PreparedQuery query(makeModel<fcl::OBBRSSd>(scene->a), makeModel<fcl::OBBRSSd>(scene->b));
    for (const ProbabilityMethod method :
         {ProbabilityMethod::automatic, ProbabilityMethod::estimate, ProbabilityMethod::convex_pcd,
          ProbabilityMethod::general_pcd_min, ProbabilityMethod::monte_carlo,
          ProbabilityMethod::rare_event}) {
      ProbabilityRequest request;
      request.method = method;
      request.relative_tolerance = 0.05;
      request.samples = 1000;
      ProbabilityResult result;
      const double p = query.collisionProbability(scene->pose_a, scene->pose_b, scene->displacement,
                                                  request, result);
      INFO(name << " by " << toString(method) << ": " << p);
      CHECK_FALSE(result.plan.empty());
      CHECK(result.lower.value_or(0.0) <= scene->reference.upper);
      CHECK(result.upper.value_or(1.0) >= scene->reference.lower);
      CHECK(result.upper.has_value() == certified(method));
      if (result.standard_error) {
        CHECK(std::abs(p - scene->estimate) <= 4 * *result.standard_error);
      }
      if (method == ProbabilityMethod::automatic) {
        CHECK(result.method == ProbabilityMethod::interval);
        CHECK(*result.upper - *result.lower <= 0.05 * *result.upper);
      }
    }
  }
}

TEST_CASE("a threshold is decided with less work than a value") {
  const auto scene = benchmarkSceneOrSkip("bunny_5cm");
  if (!scene) return;
  const PreparedQuery query(makeModel<fcl::OBBRSSd>(scene->a), makeModel<fcl::OBBRSSd>(scene->b));
  const auto run = [&](std::optional<double> threshold) {
    ProbabilityRequest request;
    request.threshold = threshold;
    ProbabilityResult result;
    query.collisionProbability(scene->pose_a, scene->pose_b, scene->displacement, request, result);
    return result;
  };
  const ProbabilityResult value = run(std::nullopt);
  CHECK(value.decision == Decision::none);
  const ProbabilityResult below = run(0.2);
  CHECK(below.decision == Decision::below);
  CHECK(below.status == ProbabilityStatus::decided);
  CHECK(*below.upper < 0.2);
  CHECK(below.statistics.cells < value.statistics.cells / 2);
  const ProbabilityResult above = run(0.05);
  CHECK(above.decision == Decision::above);
  CHECK(*above.lower > 0.05);
  CHECK(above.statistics.cells < value.statistics.cells / 2);
}
