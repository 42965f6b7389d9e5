// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The rows of bench table2 against certified intervals of the same states.
#ifdef FCL_PROB_HAS_PLANNING
#include <cmath>
#include <limits>

#include "catch.h"
#include "cli/table2_methods.h"
#include "models.h"

using namespace fcl_prob;
using namespace fcl_prob::cli;

namespace {

void checkRow(const Table2Method& method, const Eigen::VectorXd& values, const Bounds& truth) {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  CAPTURE(method.name, truth.lower, truth.upper);
  if (method.is_certified) {
    const bool below = method.probability(values, 0.05) < 0.05;
    if (below) CHECK(truth.lower < 0.05);
    if (!below) CHECK(truth.upper >= 0.05);
  } else if (method.published == "monte-carlo") {
    const double error = 5.0 * std::sqrt(truth.upper / 10'000) + 5e-4;
    const double share = method.probability(values, kAll);
    CHECK(share >= truth.lower - error);
    CHECK(share <= truth.upper + error);
  } else if (method.has_probability) {
    CHECK(method.probability(values, kAll) >= truth.lower);
  }
}

}  // namespace

TEST_CASE("no row of table2 is below what is certain, but padding", "[cli][slow]") {
  if (!fcl_prob_test::modelOrSkip("fetch_robot/fetch.srdf")) return;
  const auto scenes = table2Scenes(*fcl_prob_test::modelsFolder());
  REQUIRE(scenes.size() == 2);
  for (const Table2Scene& scene : scenes) {
    CHECK_FALSE(scene.self.collides(scene.start));
    CHECK_FALSE(scene.self.collides(scene.goal));
    const auto methods = table2Methods(scene, 0.05, 1);
    CHECK(methods.size() == 10);
    for (const double at : {0.0, 0.2, 0.3}) {
      const Eigen::VectorXd values = scene.start + at * (scene.goal - scene.start);
      ProbabilityRequest request;
      request.relative_tolerance = 0.1;
      request.max_cells = 20'000;
      const Bounds truth = scene.query.state(values, request).any;
      for (const Table2Method& method : methods) checkRow(method, values, truth);
    }
  }
}
#endif
