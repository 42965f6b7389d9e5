// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/partition.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "base/decision.h"
#include "base/number_text.h"
#include "carving/carved_partition.h"
#include "carving/column_bounds.h"
#include "cells/claim_observer.h"
#include "fcl_prob/exceptions.h"
#include "geometry/validation.h"
#include "partition/cell_sampling.h"
#include "partition/line_estimate.h"
#include "partition/partition_engine.h"
#include "partition/query_frame.h"
#include "partition/without_contact.h"

namespace fcl_prob::detail {

namespace {

class StageClock {
 public:
  explicit StageClock(ProbabilityStatistics& statistics) : statistics_(statistics) {}

  void finish(const std::string& stage) {
    const auto now = std::chrono::steady_clock::now();
    statistics_.seconds.emplace_back(stage, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }

  /// What is left of a limit on the time of all stages.
  double leftOf(double limit) const {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - started_;
    return std::max(0.0, limit - spent.count());
  }

 private:
  ProbabilityStatistics& statistics_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_ = started_;
};

constexpr const char* kNoGradient =
    "no gradient: what the mean changes where A does not move is no moment of the section";

// ∂P/∂mean = Wᵀ E[y 1_V] (the log density's derivative). Only with a density: where A does not
// move, P still changes with the mean, by what the boundary of the section sweeps, which no moment
// of the section tells.
void fillGradient(const QueryFrame& frame, const MomentBounds& moment, ProbabilityResult& result) {
  const Eigen::Matrix3d moving = frame.whitening.matrix();
  const Eigen::Vector3d middle = 0.5 * (moment.lower + moment.upper);
  const Eigen::Vector3d half = 0.5 * (moment.upper - moment.lower);
  const Eigen::Vector3d gradient = moving.transpose() * middle;
  const Eigen::Vector3d radius = moving.cwiseAbs().transpose() * half +
                                 1e-14 * (moving.cwiseAbs().transpose() * middle.cwiseAbs());
  result.gradient = gradient;
  result.gradient_lower = gradient - radius;
  result.gradient_upper = gradient + radius;
}

void fillEstimate(const QueryFrame& frame, const PartitionEngine& engine,
                  const SampledMass& sampled, bool with_gradient, ProbabilityResult& result) {
  const EngineEstimate estimate = engine.estimate(sampled);
  result.estimate = estimate.value;
  result.standard_error = estimate.standard_error;
  result.statistics.samples = sampled.samples;
  if (!with_gradient) return;
  const Eigen::Matrix3d moving = frame.whitening.matrix();
  Eigen::Vector3d moment = engine.settled().moment + sampled.moment;
  for (const OpenCell& cell : engine.openCells()) moment += engine.coveredPart(cell).moment;
  result.gradient = moving.transpose() * moment;
  const Eigen::Vector3d doubt = moving.cwiseAbs().transpose() * sampled.moment_doubt;
  Eigen::Vector3d of_moment;
  for (int k = 0; k < 3; ++k) {
    of_moment[k] = sampled.moment_spread[static_cast<std::size_t>(k)].standardError();
  }
  const Eigen::Vector3d variance =
      moving.cwiseAbs2().transpose() * of_moment.cwiseAbs2() + doubt.cwiseAbs2();
  result.gradient_standard_error = variance.cwiseSqrt();
}

void describe(const QueryFrame& frame, int of_covariance, bool solids,
              const ProbabilityRequest& request, ProbabilityResult& result) {
  const int rank = frame.whitening.rank();
  result.plan.push_back("partition of the displacement space into " +
                        std::to_string(result.statistics.cells) + " cells, " +
                        std::to_string(result.statistics.leaf_pairs) + " pairs of pieces refined");
  if (rank < of_covariance) {
    result.plan.push_back(
        "deviations below what positions are rounded by: " + std::to_string(of_covariance - rank) +
        " axes left out of the cells, their reach added to the rounding");
  }
  if (of_covariance < 3) {
    result.plan.push_back("covariance of rank " + std::to_string(of_covariance) + ": " +
                          std::to_string(3 - of_covariance) + " axes left out of the cells");
  }
  if (request.gradient && rank < 3) result.plan.push_back(kNoGradient);
  if (request.hasBand()) {
    result.plan.push_back(
        "holds for all shapes within bands of " +
        numberText(request.band_a.outward + request.band_b.outward) + " m outwards and " +
        numberText(request.band_a.inward + request.band_b.inward) + " m inwards, added up");
  }
  if (solids) result.plan.push_back("containment decided once for every free cell");
}

// A standard error that is larger than asked for by no more than this factor is made smaller by
// more samples of the same cells, otherwise by dividing them, too.
constexpr double kMostDrawnAgain = 1.6;

// Samples what the engine leaves open. Where that varies more than expected, more samples are drawn
// or more cells are divided: until the standard error is what was asked for, or a limit is reached.
SampledMass sampleOpenCells(PartitionEngine& engine, CellSampler& sampler,
                            const ProbabilityStatistics& statistics, ProbabilityStatus& status) {
  constexpr int kMostTimesDrawnAgain = 2;
  constexpr double kReserve = 1.1;
  std::optional<ProbabilityStatus> interrupted;
  const auto draw = [&](double count) {
    if (status == ProbabilityStatus::cancelled) interrupted = status;  // and not asked again
    return sampler.sample(engine.openCells(), count, [&] {
      if (!interrupted) interrupted = engine.interruption();
      return interrupted.has_value();
    });
  };
  double drawn = engine.samplesToDraw(status);
  SampledMass sampled = draw(drawn);
  int times_again = 0;
  while (status == ProbabilityStatus::converged && !interrupted) {
    const EngineEstimate estimate = engine.estimate(sampled);
    const double target = engine.targetError(estimate.value);
    if (!(estimate.standard_error > target)) return sampled;
    if (sampled.doubt > target) {
      status = ProbabilityStatus::resolution_limit;
      return sampled;
    }
    const double ratio = estimate.standard_error / target;
    if (ratio <= kMostDrawnAgain && ++times_again <= kMostTimesDrawnAgain) {
      const double more = (kReserve * ratio * ratio - 1.0) * drawn;
      const SampledMass again = draw(more);
      if (!again.interrupted) sampled = average(sampled, again);
      drawn += more;
      continue;
    }
    times_again = 0;
    const std::size_t cells = statistics.cells;
    const double drawn_before = std::exchange(drawn, 0.0);
    engine.expectDeviation(kReserve * std::max(ratio, kReserve));
    status = engine.run(true);
    drawn = engine.samplesToDraw(status);
    sampled = draw(drawn);
    // Numbers so small that neither cells nor samples make a difference.
    const bool stands_still = statistics.cells == cells && !(drawn > drawn_before);
    if (stands_still && status == ProbabilityStatus::converged) {
      status = ProbabilityStatus::resolution_limit;
    }
  }
  // Who cancels is not asked again, by another method either, whatever limit was reached before.
  const bool cancelled = interrupted == ProbabilityStatus::cancelled;
  if (interrupted && (cancelled || status == ProbabilityStatus::converged)) status = *interrupted;
  return sampled;
}

// Polytope cells, within what is left of the limits. The interval is that of all so far.
bool carveInTime(const PartitionObject& a, const PartitionObject& b, const QueryFrame& frame,
                 const SolidContact* solids, const ProbabilityRequest& whole_request,
                 StageClock& clock, Bounds& known, ProbabilityResult& result) {
  ProbabilityRequest request = whole_request;
  if (request.time_limit) request.time_limit = clock.leftOf(*request.time_limit);
  const bool reached =
      carve(a, b, frame.displacement, frame.whitening, frame.pair, solids, request, result);
  clock.finish("carving");
  known.lower = std::max(known.lower, result.lower.value_or(0.0));
  known.upper = std::min(known.upper, result.upper.value_or(1.0));
  result.lower = known.lower;
  result.upper = known.upper;
  if (reached) result.decision = decisionOf({*result.lower, *result.upper}, request);
  return reached;
}

// Of the relative tolerance, by how many deviations rounding may move the ends of lines, whose
// errors it is no part of.
constexpr double kMostRoundingOfLines = 0.03;

// The estimate by lines, where an object can be taken whole and nothing but P is asked for.
bool estimateByLines(const PartitionObject& a, const PartitionObject& b, const QueryFrame& frame,
                     const SolidContact* solids, const ProbabilityRequest& request,
                     ProbabilityResult& result) {
  if (request.gradient || request.threshold) return false;
  const auto lines =
      WholeBodyLines::of(frame.pair, a, b, frame.displacement, frame.whitening.matrix(), solids);
  if (!lines || !lines->isExact()) return false;
  if (lines->rounding() > kMostRoundingOfLines * request.relative_tolerance) return false;
  const EngineLimits limits(request, result.statistics);
  const auto estimate = lineEstimate(
      *lines, request, [&limits](const Bounds& now) { return limits.interruption(now); });
  if (!estimate) return false;
  result.status = estimate->status;
  result.estimate = estimate->value;
  result.standard_error = estimate->standard_error;
  result.lower = 0.0;
  result.upper = estimate->upper;
  result.statistics.cells = estimate->columns;
  result.statistics.samples = estimate->lines;
  result.plan.push_back("mean over " + std::to_string(estimate->lines) + " parallel lines in " +
                        std::to_string(estimate->columns) +
                        " columns, against convex meshes taken whole; cells left out");
  return true;
}

// What columns tell, where an object can be taken whole. The interval is that of all so far.
std::optional<ColumnBounds> lookAtColumns(const PartitionObject& a, const PartitionObject& b,
                                          const QueryFrame& frame, const SolidContact* solids,
                                          const ProbabilityRequest& request, Bounds& known,
                                          ProbabilityResult& result) {
  const auto lines =
      WholeBodyLines::of(frame.pair, a, b, frame.displacement, frame.whitening.matrix(), solids);
  if (!lines) return std::nullopt;
  const ColumnBounds columns = columnBounds(*lines, *request.threshold, request.max_cells);
  known = columns.bounds;
  result.lower = known.lower;
  result.upper = known.upper;
  result.decision = decisionOf(known, request);
  if (result.decision == Decision::undecided) return columns;
  result.method = ProbabilityMethod::interval;
  result.status = ProbabilityStatus::decided;
  result.statistics.cells = columns.columns;
  result.plan.push_back("decided by bounds on " + std::to_string(columns.columns) +
                        " columns, against convex meshes taken whole; cells left out");
  return columns;
}

// Boxes seldom decide where P is as near to the threshold as this share of it, unless there are
// many members.
constexpr double kNearThreshold = 0.5;

bool isNearThreshold(const ColumnBounds& columns, double threshold) {
  return std::fabs(columns.likely - threshold) < kNearThreshold * threshold;
}

// A decision is left to polytope cells when it needs more boxes than these. Measured on links
// beside an arm (`bench states`): 12, 32, 128 and 256 are slower.
constexpr std::size_t kBoxesBeforeCarving = 64;

}  // namespace

ProbabilityResult partitionProbability(const PartitionObject& a, const PartitionObject& b,
                                       const GaussianDisplacement& displacement,
                                       const ProbabilityRequest& whole_request,
                                       const BallTruncation* ball) {
  if (a.tree->isEmpty() || b.tree->isEmpty()) {
    return withoutContact(whole_request, "an octree without occupied cells collides with nothing");
  }
  if (displacement.rank() > 0 && std::max(a.tree->radius(), b.tree->radius()) < kLeastSize) {
    requireMeasurable(a.tree->radius(), b.tree->radius());
  }
  ProbabilityResult result;
  StageClock clock(result.statistics);
  ProbabilityRequest request = whole_request;
  Bounds known{0.0, 1.0};
  const QueryFrame frame = queryFrame(a, b, displacement, request, ball != nullptr);
  bool may_be_carved =
      !ball && !request.hasBand() && mayBeCarved(a, b, frame.displacement, request);
  std::unique_ptr<SolidContact> solids;
  if (a.hasSolid() || b.hasSolid()) {
    solids = std::make_unique<SolidContact>(a, b, frame.whitening, frame.pair);
  }
  const auto announceFrame = [&] {
    if (claim_observer) claim_observer->frame(frame.whitening, displacement);
  };
  // What carving claimed is over if it did not get there.
  const auto carvedInstead = [&] {
    const bool reached =
        carveInTime(a, b, frame, solids.get(), whole_request, clock, known, result);
    if (!reached) announceFrame();
    return reached;
  };
  announceFrame();
  clock.finish("whitening");
  if (may_be_carved && !request.threshold) {
    if (carvedInstead()) return result;
    may_be_carved = false;
  }

  const bool estimate = request.method == ProbabilityMethod::estimate;
  result.method = estimate ? ProbabilityMethod::estimate : ProbabilityMethod::interval;
  if (request.time_limit) request.time_limit = clock.leftOf(*request.time_limit);
  if (estimate && !ball && estimateByLines(a, b, frame, solids.get(), request, result)) {
    clock.finish("lines");
    return result;
  }
  if (may_be_carved) {
    const auto columns = lookAtColumns(a, b, frame, solids.get(), request, known, result);
    clock.finish("columns");
    if (result.status == ProbabilityStatus::decided) return result;
    const bool is_pair = a.parts.size() == 1 && b.parts.size() == 1;
    if (is_pair && columns && isNearThreshold(*columns, *request.threshold)) {
      if (carvedInstead()) return result;
      may_be_carved = false;
    }
  }
  if (may_be_carved) request.max_cells = std::min(request.max_cells, kBoxesBeforeCarving);
  PartitionEngine engine({frame.pair, frame.whitening.rank(), solids.get(), ball, request.gradient,
                          estimate, request.relative_tolerance},
                         request, result.statistics);
  const auto makeTester = [&] {
    return std::make_unique<PointTester>(
        frame.pair, engine.obstacles(), solids.get(),
        WholeBodyTester::of(frame.pair, a, b, frame.displacement, frame.whitening.matrix()));
  };
  std::unique_ptr<PointTester> tester;
  if (estimate) tester = makeTester();
  if (tester && tester->isQuick()) engine.expectQuickSamples();
  result.status = engine.run(estimate);
  clock.finish("partition");
  if (result.status == ProbabilityStatus::cell_limit &&
      request.max_cells < whole_request.max_cells) {
    const Bounds of_boxes = engine.interval();
    known = {std::max(known.lower, of_boxes.lower), std::min(known.upper, of_boxes.upper)};
    if (carvedInstead()) return result;
    request.max_cells = whole_request.max_cells;
    result.status = engine.run(estimate);
    clock.finish("partition");
  }
  SampledMass sampled;
  if (estimate) {
    if (tester->isQuick()) {
      result.plan.push_back(
          "samples tested against convex meshes taken whole, not triangle by triangle");
    }
    if (request.threads > 1) engine.obstacles().share();
    CellSampler sampler(std::move(tester), makeTester, request.seed,
                        claim_observer ? 1 : request.threads);
    sampled = sampleOpenCells(engine, sampler, result.statistics, result.status);
    clock.finish("sampling");
  }
  const Bounds interval = engine.interval();
  result.lower = std::max(interval.lower, known.lower);
  result.upper = std::min(interval.upper, known.upper);
  const bool with_gradient = request.gradient && frame.whitening.rank() == 3;
  if (with_gradient) fillGradient(frame, engine.moment(), result);
  if (estimate) fillEstimate(frame, engine, sampled, with_gradient, result);
  result.decision = decisionOf({*result.lower, *result.upper}, request);
  describe(frame, displacement.rank(), solids != nullptr, request, result);
  return result;
}

}  // namespace fcl_prob::detail
