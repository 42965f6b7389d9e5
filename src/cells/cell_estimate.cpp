// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/cell_estimate.h"

#include <cmath>
#include <optional>
#include <utility>

namespace fcl_prob::detail {
namespace {

// A standard error that is larger than asked for by no more than this factor is made smaller by
// more samples of the same cells, otherwise by dividing them, too.
constexpr double kMostDrawnAgain = 1.6;

}  // namespace

void fillGradient(const Whitening& whitening, const MomentBounds& moment,
                  ProbabilityResult& result) {
  const Eigen::Matrix3d& moving = whitening.matrix();
  const Eigen::Vector3d middle = 0.5 * (moment.lower + moment.upper);
  const Eigen::Vector3d half = 0.5 * (moment.upper - moment.lower);
  const Eigen::Vector3d gradient = moving.transpose() * middle;
  const Eigen::Vector3d radius = moving.cwiseAbs().transpose() * half +
                                 1e-14 * (moving.cwiseAbs().transpose() * middle.cwiseAbs());
  result.gradient = gradient;
  result.gradient_lower = gradient - radius;
  result.gradient_upper = gradient + radius;
}

void fillEstimate(const Whitening& whitening, const PartitionEngine& engine,
                  const SampledMass& sampled, bool with_gradient, ProbabilityResult& result) {
  const EngineEstimate estimate = engine.estimate(sampled);
  result.estimate = estimate.value;
  result.standard_error = estimate.standard_error;
  result.statistics.samples = sampled.samples;
  if (!with_gradient) return;
  const Eigen::Matrix3d& moving = whitening.matrix();
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

}  // namespace fcl_prob::detail
