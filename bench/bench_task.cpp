// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/bench_task.h"

#include <algorithm>

#include "cli/number_text.h"

namespace fcl_prob::cli {
namespace {

std::string percentText(double share) { return numberText(100.0 * share, 3) + " %"; }

}  // namespace

ProbabilityRequest BenchTask::request(std::uint64_t seed) const {
  ProbabilityRequest request;
  request.method = method;
  request.relative_tolerance = relative_tolerance;
  request.absolute_tolerance = 0.0;
  request.threshold = threshold;
  request.seed = seed;
  return request;
}

BenchTask intervalTask(double relative_tolerance) {
  return {"interval " + percentText(relative_tolerance), ProbabilityMethod::interval,
          relative_tolerance, std::nullopt};
}

BenchTask estimateTask(double relative_tolerance) {
  return {"estimate " + percentText(relative_tolerance), ProbabilityMethod::estimate,
          relative_tolerance, std::nullopt};
}

BenchTask decisionTask(double threshold) {
  return {"decision P < " + percentText(threshold), ProbabilityMethod::interval, 1e-9, threshold};
}

TimedResult quickestOfThree(const PreparedScene& scene, const ProbabilityRequest& request) {
  constexpr double kLong_ms = 2000.0;
  TimedResult best = scene.query(request);
  for (int i = 1; i < 3 && best.time_ms < kLong_ms; ++i) {
    best.time_ms = std::min(best.time_ms, scene.query(request).time_ms);
  }
  return best;
}

}  // namespace fcl_prob::cli
