// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/partition.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>

#include "partition/cell_sampling.h"
#include "partition/claim_observer.h"
#include "partition/closest_approach.h"
#include "partition/partition_engine.h"
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

 private:
  ProbabilityStatistics& statistics_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// Whitening stretches the objects by this ratio at most where the frame is turned: a long stretch
// that is not along an axis would make their bounding boxes useless.
constexpr double kMostStretched = 30.0;

// The whitened frame with its first axis along the direction of closest approach, so that the
// boundary of the C-obstacle lies across one axis of the cells.
struct QueryFrame {
  Whitening whitening;
  WhitenedPair pair;
};

QueryFrame queryFrame(const PartitionObject& a, const PartitionObject& b,
                      const GaussianDisplacement& displacement) {
  const double unit = std::max({a.tree->radius(), b.tree->radius(), 1e-150});
  const Whitening plain(displacement, unit);
  WhitenedPair pair = whiten(a, b, plain);
  const Eigen::Vector3d& sigma = displacement.standardDeviations();
  if (displacement.rank() < 2 || sigma[0] > kMostStretched * sigma[displacement.rank() - 1]) {
    return {plain, std::move(pair)};
  }
  const Whitening rotated = plain.rotatedTo(closestApproach(pair, displacement.rank()));
  whiten(a, b, rotated, pair);
  return {rotated, std::move(pair)};
}

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
  result.estimate = engine.estimate(sampled);
  result.standard_error = sampled.standardError();
  result.statistics.samples = sampled.samples;
  if (!with_gradient) return;
  const Eigen::Matrix3d moving = frame.whitening.matrix();
  Eigen::Vector3d moment = engine.settled().moment + sampled.moment;
  for (const OpenCell& cell : engine.openCells()) moment += engine.coveredPart(cell).moment;
  result.gradient = moving.transpose() * moment;
  const Eigen::Vector3d doubt = moving.cwiseAbs().transpose() * sampled.moment_doubt;
  const Eigen::Vector3d variance =
      moving.cwiseAbs2().transpose() * sampled.moment_variance + doubt.cwiseAbs2();
  result.gradient_standard_error = variance.cwiseSqrt();
}

void decide(const ProbabilityRequest& request, ProbabilityResult& result) {
  if (!request.threshold) return;
  result.decision = *result.upper < *request.threshold   ? Decision::below
                    : *result.lower > *request.threshold ? Decision::above
                                                         : Decision::undecided;
}

void describe(const QueryFrame& frame, bool solids, const ProbabilityRequest& request,
              ProbabilityResult& result) {
  const int rank = frame.whitening.rank();
  result.plan.push_back("partition of the displacement space into " +
                        std::to_string(result.statistics.cells) + " cells, " +
                        std::to_string(result.statistics.leaf_pairs) + " pairs of pieces refined");
  if (rank < 3) {
    result.plan.push_back("covariance of rank " + std::to_string(rank) + ": " +
                          std::to_string(3 - rank) + " axes left out of the cells");
  }
  if (request.gradient && rank < 3) result.plan.push_back(kNoGradient);
  if (solids) result.plan.push_back("containment decided once for every free cell");
}

// A standard error that is larger than asked for by no more than this factor is made smaller by
// more samples of the same cells, otherwise by dividing them, too.
constexpr double kMostDrawnAgain = 1.6;

// Samples what the engine leaves open. Where that varies more than expected, more samples are drawn
// or more cells are divided.
SampledMass sampleOpenCells(PartitionEngine& engine, CellSampler& sampler,
                            ProbabilityStatus& status) {
  constexpr int kMostRounds = 4;
  constexpr double kReserve = 1.1;
  double drawn = engine.samplesToDraw(status);
  SampledMass sampled = sampler.sample(engine.openCells(), drawn);
  for (int round = 1; round < kMostRounds && status == ProbabilityStatus::converged; ++round) {
    const double target = engine.targetError(engine.estimate(sampled));
    if (sampled.doubt > target) {
      status = ProbabilityStatus::resolution_limit;
      break;
    }
    const double ratio = sampled.standardError() / target;
    if (!(ratio > 1.0)) break;
    if (ratio <= kMostDrawnAgain) {
      const double more = (kReserve * ratio * ratio - 1.0) * drawn;
      sampled = average(sampled, sampler.sample(engine.openCells(), more));
      drawn += more;
      continue;
    }
    engine.expectDeviation(kReserve * ratio);
    status = engine.run(true);
    drawn = engine.samplesToDraw(status);
    sampled = sampler.sample(engine.openCells(), drawn);
  }
  return sampled;
}

bool hasSolids(const PartitionObject& object) {
  return std::any_of(object.parts.begin(), object.parts.end(),
                     [](const PlacedPart& part) { return part.solid != nullptr; });
}

}  // namespace

ProbabilityResult partitionProbability(const PartitionObject& a, const PartitionObject& b,
                                       const GaussianDisplacement& displacement,
                                       const ProbabilityRequest& request,
                                       const BallTruncation* ball) {
  if (a.tree->isEmpty() || b.tree->isEmpty()) {
    return withoutContact(request, "an octree without occupied cells collides with nothing");
  }
  ProbabilityResult result;
  StageClock clock(result.statistics);
  const QueryFrame frame = queryFrame(a, b, displacement);
  std::unique_ptr<SolidContact> solids;
  if (hasSolids(a) || hasSolids(b)) {
    solids = std::make_unique<SolidContact>(a, b, frame.whitening, frame.pair);
  }
  if (claim_observer) claim_observer->frame(frame.whitening, displacement);
  clock.finish("whitening");

  const bool estimate = request.method == ProbabilityMethod::estimate;
  result.method = estimate ? ProbabilityMethod::estimate : ProbabilityMethod::interval;
  PartitionEngine engine(frame.pair, frame.whitening.rank(), solids.get(), ball, request,
                         result.statistics);
  result.status = engine.run(estimate);
  clock.finish("partition");
  SampledMass sampled;
  if (estimate) {
    CellSampler sampler(frame.pair, engine.obstacles(), solids.get(), request.seed);
    sampled = sampleOpenCells(engine, sampler, result.status);
    clock.finish("sampling");
  }
  const Bounds interval = engine.interval();
  result.lower = interval.lower;
  result.upper = interval.upper;
  const bool with_gradient = request.gradient && frame.whitening.rank() == 3;
  if (with_gradient) fillGradient(frame, engine.moment(), result);
  if (estimate) fillEstimate(frame, engine, sampled, with_gradient, result);
  decide(request, result);
  describe(frame, solids != nullptr, request, result);
  return result;
}

}  // namespace fcl_prob::detail
