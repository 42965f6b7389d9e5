// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/comparison.h"

#include <cmath>
#include <limits>
#include <sstream>

namespace fcl_prob::cli {
namespace {

// The reference is a hundred times tighter than the tightest budget, if the clock allows.
constexpr double kReferenceTolerance = 1e-5;
constexpr double kReferenceSeconds = 12.0;
constexpr std::size_t kReferenceSamples = 200'000;

constexpr double kDefaultRunSeconds = 10.0;

// So small that a sampling method draws all of its samples.
constexpr double kNoTolerance = 1e-300;

std::string percent(double fraction) {
  std::ostringstream text;
  text << 100.0 * fraction << " %";
  return text.str();
}

class RunList {
 public:
  explicit RunList(ProbabilityRequest base) : base_(std::move(base)) {
    base_.threshold.reset();
    base_.gradient = false;
    if (!base_.time_limit) base_.time_limit = kDefaultRunSeconds;
  }

  void byTolerance(ProbabilityMethod method, std::initializer_list<double> tolerances) {
    for (const double tolerance : tolerances) {
      ProbabilityRequest& request = add(method, percent(tolerance));
      request.relative_tolerance = tolerance;
      request.absolute_tolerance = 0.0;
    }
  }

  void bySamples(ProbabilityMethod method, std::initializer_list<std::size_t> counts) {
    for (const std::size_t count : counts) {
      ProbabilityRequest& request = add(method, std::to_string(count) + " samples");
      request.samples = count;
      request.relative_tolerance = kNoTolerance;
      request.absolute_tolerance = 0.0;
    }
  }

  void byDelta(ProbabilityMethod method, std::initializer_list<double> deltas) {
    for (const double delta : deltas) {
      std::ostringstream text;
      text << "delta " << delta;
      add(method, text.str()).confidence = delta;
    }
  }

  void once(ProbabilityMethod method) { add(method, "-"); }

  void prior(const PriorRun& run) {
    runs_.push_back({toString(run.method), run.budget(), base_, run});
  }

  const std::vector<ComparisonRun>& runs() const { return runs_; }

 private:
  ProbabilityRequest& add(ProbabilityMethod method, const std::string& budget) {
    runs_.push_back({toString(method), budget, base_, std::nullopt});
    runs_.back().request.method = method;
    return runs_.back().request;
  }

  ProbabilityRequest base_;
  std::vector<ComparisonRun> runs_;
};

ComparisonReference certifiedReference(const PreparedScene& scene, ProbabilityRequest request) {
  request.method = ProbabilityMethod::interval;
  request.relative_tolerance = kReferenceTolerance;
  request.absolute_tolerance = 0.0;
  request.time_limit = kReferenceSeconds;
  const TimedResult timed = scene.query(request);
  ComparisonReference reference;
  reference.interval = {timed.result.lower.value(), timed.result.upper.value()};
  reference.value = reference.interval.middle();
  reference.kind = ReferenceKind::certified;
  reference.time_ms = timed.time_ms;
  return reference;
}

ComparisonReference sampledReference(const PreparedScene& scene, ProbabilityRequest request) {
  request.method = ProbabilityMethod::monte_carlo;
  request.samples = kReferenceSamples;
  request.seed = ~request.seed;  // not the samples that are to be judged
  request.relative_tolerance = kNoTolerance;
  request.absolute_tolerance = 0.0;
  request.time_limit = kReferenceSeconds;
  const TimedResult timed = scene.query(request);
  return {timed.result.probability(), timed.result.confidence_interval.value(),
          ReferenceKind::counted, timed.time_ms};
}

// Counting would take a hundred times as long for the same confidence.
ComparisonReference estimatedReference(const PreparedScene& scene, ProbabilityRequest request) {
  request.method = ProbabilityMethod::estimate;
  request.seed = ~request.seed;
  request.relative_tolerance = 2e-4;
  request.absolute_tolerance = 0.0;
  request.time_limit = kReferenceSeconds;
  const TimedResult timed = scene.query(request);
  const Bounds interval = timed.result.confidence_interval.value_or(Bounds{0.0, 1.0});
  return {timed.result.probability(), interval, ReferenceKind::estimated, timed.time_ms};
}

ComparisonReference referenceFor(const PreparedScene& scene, ProbabilityRequest base) {
  base.threshold.reset();
  if (scene.poseError() && scene.poseError()->rotationRank() > 0) {
    return estimatedReference(scene, base);
  }
  try {
    return certifiedReference(scene, base);
  } catch (const UnsupportedGeometry&) {
    return sampledReference(scene, base);
  }
}

/// A result, and a name for its status that ProbabilityStatus may not have.
struct Answer {
  TimedResult timed;
  std::string status;
};

Answer answerOf(const PreparedScene& scene, const PriorScene& prior_scene,
                const ComparisonRun& run) {
  if (!run.prior) {
    const TimedResult timed = scene.query(run.request);
    return {timed, toString(timed.result.status)};
  }
  if (scene.poseError()) {
    throw UnsupportedGeometry(run.method + " knows errors of positions only");
  }
  const PriorAnswer prior = prior_scene.answer(*run.prior, run.request.contact);
  Answer answer;
  answer.timed.time_ms = prior.time_ms;
  answer.timed.result.status = ProbabilityStatus::bound_only;
  answer.timed.result.upper = prior.upper;
  answer.timed.result.statistics.raw_sum = prior.raw;
  if (!prior.upper) answer.timed.result.estimate = prior.value;
  answer.status = prior.upper ? toString(ProbabilityStatus::bound_only) : "approximation";
  return answer;
}

/// Runs that are over in a moment are repeated, and the quickest counts: the first one pays for
/// caches and page faults that are not the method's.
Answer quickest(const PreparedScene& scene, const PriorScene& prior_scene,
                const ComparisonRun& run) {
  constexpr double kMoment_ms = 10.0;
  constexpr int kRepeats = 5;
  Answer best = answerOf(scene, prior_scene, run);
  for (int i = 1; i < kRepeats && best.timed.time_ms < kMoment_ms; ++i) {
    best.timed.time_ms =
        std::min(best.timed.time_ms, answerOf(scene, prior_scene, run).timed.time_ms);
  }
  return best;
}

double relative(double error, double reference) {
  if (error == 0.0) return 0.0;
  return reference > 0.0 ? error / reference : std::numeric_limits<double>::infinity();
}

ComparisonRecord record(const PreparedScene& scene, const PriorScene& prior_scene,
                        const ComparisonRun& run, const ComparisonReference& reference) {
  ComparisonRecord result;
  result.method = run.method;
  result.budget = run.budget;
  try {
    const Answer answer = quickest(scene, prior_scene, run);
    result.result = answer.timed.result;
    result.time_ms = answer.timed.time_ms;
    result.status = answer.status;
  } catch (const Exception& error) {
    result.refusal = error.what();
    return result;
  }
  result.value = result.result.probability();
  result.error = std::abs(result.value - reference.value);
  result.relative_error = relative(result.error, reference.value);
  return result;
}

}  // namespace

std::vector<ComparisonRun> defaultRuns(const ProbabilityRequest& base) {
  using Method = ProbabilityMethod;
  RunList list(base);
  list.once(Method::exact);
  list.byTolerance(Method::interval, {0.1, 0.01, 0.001});
  list.byTolerance(Method::estimate, {0.1, 0.01, 0.003, 0.001});
  list.bySamples(Method::monte_carlo, {100, 1'000, 10'000, 100'000});
  list.bySamples(Method::rare_event, {1'000, 10'000});
  list.once(Method::convex_pcd);
  list.byDelta(Method::general_pcd, {0.9, 0.99, 0.999});
  list.byDelta(Method::general_pcd_min, {0.9, 0.99, 0.999});
  for (const PriorRun& run : priorRunsOfComparison()) list.prior(run);
  return list.runs();
}

Comparison compare(const PreparedScene& scene, const std::vector<ComparisonRun>& runs,
                   const ProbabilityRequest& base, const ComparisonProgress& progress) {
  Comparison comparison;
  comparison.build_ms = scene.buildTime();
  comparison.nominal = scene.nominal();
  if (!progress(0, runs.size() + 1, "reference")) return comparison;
  comparison.reference = referenceFor(scene, base);
  const PriorScene prior_scene(scene);
  for (const ComparisonRun& run : runs) {
    const std::string what = run.method + " " + run.budget;
    if (!progress(comparison.records.size() + 1, runs.size() + 1, what)) break;
    comparison.records.push_back(record(scene, prior_scene, run, comparison.reference));
  }
  return comparison;
}

}  // namespace fcl_prob::cli
