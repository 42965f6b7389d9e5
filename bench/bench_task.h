// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What the benchmarks ask of a scene.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/prepared_scene.h"

namespace fcl_prob::cli {

struct BenchTask {
  std::string name;
  ProbabilityMethod method;
  double relative_tolerance;
  std::optional<double> threshold;

  /// With no absolute tolerance.
  ProbabilityRequest request(std::uint64_t seed) const;
};

BenchTask intervalTask(double relative_tolerance);
BenchTask estimateTask(double relative_tolerance);

/// Whether P is below the threshold, however close it comes.
BenchTask decisionTask(double threshold);

/// Three runs, or one if it is long: the results are the same, and the quickest time counts.
TimedResult quickestOfThree(const PreparedScene& scene, const ProbabilityRequest& request);

}  // namespace fcl_prob::cli
