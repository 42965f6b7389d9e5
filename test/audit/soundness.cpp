// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "soundness.h"

#include <cmath>

namespace fcl_prob_audit {
namespace {

using namespace fcl_prob;

bool isProbability(const std::optional<double>& value) {
  return !value || (*value >= 0.0 && *value <= 1.0);
}

bool areFinite(const ProbabilityResult& result) {
  const auto finite = [](const std::optional<double>& x) { return !x || std::isfinite(*x); };
  const auto all = [](const std::optional<Vector3d>& v) { return !v || v->allFinite(); };
  return finite(result.estimate) && finite(result.standard_error) && all(result.gradient) &&
         all(result.gradient_standard_error) && !std::isnan(result.probability());
}

bool areOrdered(const ProbabilityResult& result) {
  if (result.lower && result.upper && !(*result.lower <= *result.upper)) return false;
  if (!result.gradient_lower || !result.gradient_upper) return true;
  return (result.gradient_lower->array() <= result.gradient_upper->array()).all();
}

/// The status says that the tolerance is met.
bool keepsTolerance(const Scene& scene, const ProbabilityResult& result) {
  if (result.status != ProbabilityStatus::converged) return true;
  const ProbabilityRequest& request = scene.request;
  const bool sampled = result.method == ProbabilityMethod::estimate;
  if (sampled && result.standard_error && result.estimate) {
    const double tolerance =
        std::max(request.absolute_tolerance, request.relative_tolerance * *result.estimate);
    // An interval that is narrow enough says the same.
    const bool narrow = result.lower && result.upper && *result.upper - *result.lower <= tolerance;
    return narrow || *result.standard_error <= tolerance * (1 + 1e-9);
  }
  if (!result.lower || !result.upper) return true;
  const double tolerance =
      std::max(request.absolute_tolerance, request.relative_tolerance * *result.upper);
  return *result.upper - *result.lower <= tolerance * (1 + 1e-9);
}

bool decidesRightly(const ProbabilityRequest& request, const ProbabilityResult& result) {
  if (!request.threshold) return result.decision == Decision::none;
  // Methods that sample decide by their confidence interval.
  if (result.confidence_interval) return true;
  if (result.decision == Decision::below)
    return result.upper && *result.upper <= *request.threshold;
  if (result.decision == Decision::above)
    return result.lower && *result.lower >= *request.threshold;
  return result.status != ProbabilityStatus::decided;
}

/// Limits are looked at after some divisions of a cell only.
constexpr std::size_t kPolledLate = 256;

bool keepsLimits(const Scene& scene, const ProbabilityResult& result) {
  const ProbabilityRequest& request = scene.request;
  const bool partition =
      result.method == ProbabilityMethod::interval || result.method == ProbabilityMethod::estimate;
  if (partition && result.statistics.cells > request.max_cells + kPolledLate) return false;
  return result.method == ProbabilityMethod::estimate ||
         result.statistics.samples <= request.samples;
}

}  // namespace

void checkSound(const Scene& scene, const Answer& answer, std::vector<Violation>& found) {
  if (!answer.foreign_exception.empty()) {
    found.push_back({"exception", answer.foreign_exception});
  }
  if (!answer) return;
  const ProbabilityResult& result = *answer.result;
  const auto require = [&](bool holds, const char* check) {
    if (!holds) found.push_back({check, textOf(result)});
  };
  require(isProbability(result.lower) && isProbability(result.upper), "probability");
  require(areFinite(result), "finite");
  require(areOrdered(result), "order of bounds");
  require(keepsTolerance(scene, result), "tolerance of converged");
  require(decidesRightly(scene.request, result), "decision");
  require(keepsLimits(scene, result), "limits of counts");
  require(answer.calls_after_stop == 0, "cancellation");
}

}  // namespace fcl_prob_audit
