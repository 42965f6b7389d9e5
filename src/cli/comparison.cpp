// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "base/stopwatch.h"
#include "cloud/median.h"

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
    runs_.push_back({toString(run.method), run.budget(), base_, run, PartsUse::none});
  }

  void withParts(double delta) {
    for (const ProbabilityMethod method :
         {ProbabilityMethod::general_pcd, ProbabilityMethod::general_pcd_min}) {
      std::ostringstream text;
      text << "parts, delta " << delta;
      ProbabilityRequest& request = add(method, text.str());
      request.confidence = delta;
      runs_.back().parts = PartsUse::leaves;
    }
    runs_.push_back({kPartsBounds, "-", base_, std::nullopt, PartsUse::bounds});
  }

  const std::vector<ComparisonRun>& runs() const { return runs_; }

 private:
  ProbabilityRequest& add(ProbabilityMethod method, const std::string& budget) {
    runs_.push_back({toString(method), budget, base_, std::nullopt, PartsUse::none});
    runs_.back().request.method = method;
    return runs_.back().request;
  }

  ProbabilityRequest base_;
  std::vector<ComparisonRun> runs_;
};

// By the exact mass where there is one.
ComparisonReference certifiedReference(const PreparedScene& scene, ProbabilityRequest request) {
  request.method = ProbabilityMethod::automatic;
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

/// Hulls are the tightest volumes of general-pcd.
constexpr const char* kVolumeOfParts = "convex";

/// The scene for methods that are not those of a PreparedQuery. Meshes are decomposed when the
/// first of them is run.
class OtherMethods {
 public:
  explicit OtherMethods(const PreparedScene& scene) : scene_(scene), prior_(scene) {}

  PriorAnswer prior(const PriorRun& run, ContactMeaning contact) const {
    return prior_.answer(run, contact);
  }

  TimedResult withParts(const ComparisonRun& run) {
    if (!parts_) {
      parts_.emplace(scene_.objectA(), scene_.objectB(), scene_.displacement(), kVolumeOfParts);
    }
    TimedResult timed;
    const detail::Stopwatch watch;
    timed.result = parts_->answer(run.parts, run.request);
    timed.time_ms = watch.milliseconds();
    return timed;
  }

 private:
  const PreparedScene& scene_;
  PriorScene prior_;
  std::optional<PartsScene> parts_;
};

/// A result, and a name for its status that ProbabilityStatus may not have.
struct Answer {
  TimedResult timed;
  std::string status;
};

Answer answerOf(const PreparedScene& scene, OtherMethods& others, const ComparisonRun& run) {
  if (scene.poseError() && (run.prior || run.parts != PartsUse::none)) {
    throw UnsupportedGeometry(run.method + " knows errors of positions only");
  }
  if (!run.prior) {
    const TimedResult timed =
        run.parts == PartsUse::none ? scene.query(run.request) : others.withParts(run);
    return {timed, toString(timed.result.status)};
  }
  const PriorAnswer prior = others.prior(*run.prior, run.request.contact);
  Answer answer;
  answer.timed.time_ms = prior.time_ms;
  answer.timed.result.status = ProbabilityStatus::bound_only;
  answer.timed.result.upper = prior.upper;
  answer.timed.result.statistics.raw_sum = prior.raw;
  if (!prior.upper) answer.timed.result.estimate = prior.value;
  answer.status = prior.upper ? toString(ProbabilityStatus::bound_only) : "approximation";
  return answer;
}

bool samples(const ComparisonRun& run) {
  const ProbabilityMethod method = run.request.method;
  return !run.prior &&
         (method == ProbabilityMethod::estimate || method == ProbabilityMethod::monte_carlo ||
          method == ProbabilityMethod::rare_event);
}

/// Runs that are over in a moment are repeated, and the quickest counts: the first one pays for
/// caches and page faults that are not the method's.
Answer quickest(const PreparedScene& scene, OtherMethods& others, const ComparisonRun& run) {
  constexpr double kMoment_ms = 10.0;
  constexpr int kRepeats = 5;
  Answer best = answerOf(scene, others, run);
  for (int i = 1; i < kRepeats && best.timed.time_ms < kMoment_ms; ++i) {
    best.timed.time_ms = std::min(best.timed.time_ms, answerOf(scene, others, run).timed.time_ms);
  }
  return best;
}

double relative(double error, double reference) {
  if (error == 0.0) return 0.0;
  return reference > 0.0 ? error / reference : std::numeric_limits<double>::infinity();
}

double rootMeanSquare(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

void setError(const std::vector<double>& errors, double reference, ComparisonRecord& record) {
  record.seeds = errors.size();
  record.error = rootMeanSquare(errors);
  record.relative_error = relative(*record.error, reference);
}

void setAnswer(const Answer& answer, ComparisonRecord& record) {
  record.result = answer.timed.result;
  record.status = answer.status;
  record.value = record.result.probability();
  record.time_ms = answer.timed.time_ms;
  if (record.result.lower && record.result.upper) {
    record.stated_error = 0.5 * (*record.result.upper - *record.result.lower);
  }
}

void recordOnce(const PreparedScene& scene, OtherMethods& others, const ComparisonRun& run,
                const ComparisonReference& reference, ComparisonRecord& record) {
  setAnswer(quickest(scene, others, run), record);
  setError({std::abs(record.value - reference.value)}, reference.value, record);
}

/// One seed may be right by luck: what counts is the error that is to be expected.
void recordSeeds(const PreparedScene& scene, ComparisonRun run, std::size_t seeds,
                 const ComparisonReference& reference, ComparisonRecord& record) {
  std::vector<double> errors;
  std::vector<double> stated;
  std::vector<double> times;
  for (std::size_t i = 0; i < seeds; ++i, ++run.request.seed) {
    const TimedResult timed = scene.query(run.request);
    if (i == 0) setAnswer({timed, toString(timed.result.status)}, record);
    errors.push_back(std::abs(timed.result.probability() - reference.value));
    if (timed.result.standard_error) stated.push_back(*timed.result.standard_error);
    times.push_back(timed.time_ms);
    // A query that is cancelled says nothing about the method.
    if (timed.result.status == ProbabilityStatus::cancelled) break;
  }
  if (!stated.empty()) record.stated_error = rootMeanSquare(stated);
  record.time_ms = detail::median(times);
  record.seeds = errors.size();
  if (reference.kind != ReferenceKind::counted) setError(errors, reference.value, record);
}

ComparisonRecord recordOf(const PreparedScene& scene, OtherMethods& others,
                          const ComparisonRun& run, std::size_t seeds,
                          const ComparisonReference& reference) {
  ComparisonRecord record;
  record.method = run.method;
  record.budget = run.budget;
  try {
    if (samples(run)) {
      recordSeeds(scene, run, seeds, reference, record);
    } else {
      recordOnce(scene, others, run, reference, record);
    }
  } catch (const Exception& error) {
    record.refusal = error.what();
  }
  return record;
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
  list.withParts(0.99);
  for (const PriorRun& run : priorRunsOfComparison()) list.prior(run);
  return list.runs();
}

Comparison compare(const PreparedScene& scene, const std::vector<ComparisonRun>& runs,
                   const ProbabilityRequest& base, std::size_t seeds,
                   const ComparisonProgress& progress) {
  Comparison comparison;
  comparison.build_ms = scene.buildTime();
  comparison.nominal = scene.nominal();
  comparison.interrupted = !progress(0, runs.size() + 1, "reference");
  if (comparison.interrupted) return comparison;
  comparison.reference = referenceFor(scene, base);
  OtherMethods others(scene);
  for (const ComparisonRun& run : runs) {
    const std::string what = run.method + " " + run.budget;
    comparison.interrupted = !progress(comparison.records.size() + 1, runs.size() + 1, what);
    if (comparison.interrupted) break;
    comparison.records.push_back(recordOf(scene, others, run, seeds, comparison.reference));
  }
  return comparison;
}

}  // namespace fcl_prob::cli
