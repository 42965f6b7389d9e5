// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "sampling/sampling_run.h"

#include <algorithm>
#include <cmath>

namespace fcl_prob::detail {

SamplingRun::SamplingRun(const ProbabilityRequest& request, std::size_t samples,
                         double absolute_tolerance)
    : request_(request),
      samples_(samples),
      absolute_tolerance_(absolute_tolerance),
      looks_(samples, request.confidence),
      loop_(request.threads) {}

ProbabilityResult SamplingRun::run(Budget& budget) {
  ProbabilityResult result;
  result.status = ProbabilityStatus::sampled;
  double confidence = looks_.finalConfidence();
  while (counted_ < samples_) {
    const std::size_t look = looks_.next(counted_);
    loop_.run(
        counted_, look, [this](std::size_t index) { evaluate(index, index % kSlots); },
        [&](std::size_t done) { return countUpTo(done, budget); });
    if (interruption_) {
      result.status = *interruption_;
      break;
    }
    const double confidence_here = looks_.confidenceAt(look);
    if (const auto reason = reasonToStop(interval(confidence_here))) {
      result.status = *reason;
      confidence = confidence_here;
      break;
    }
  }
  result.confidence_interval = interval(confidence);
  result.decision = decisionOf(*result.confidence_interval, request_);
  result.statistics.samples = counted_;
  return result;
}

bool SamplingRun::countUpTo(std::size_t done, Budget& budget) {
  for (; counted_ < done; ++counted_) count(counted_, counted_ % kSlots);
  if (!interruption_ && done < samples_) {
    const double fraction = static_cast<double>(counted_) / static_cast<double>(samples_);
    interruption_ = budget.look(interval(looks_.finalConfidence()), fraction);
  }
  return !interruption_;
}

std::optional<ProbabilityStatus> SamplingRun::reasonToStop(const Bounds& interval) const {
  if (request_.threshold) {
    if (!isDecided(decisionOf(interval, request_))) return std::nullopt;
    return ProbabilityStatus::decided;
  }
  const double tolerance =
      std::max(absolute_tolerance_, request_.relative_tolerance * interval.upper);
  if (0.5 * interval.width() <= tolerance) return ProbabilityStatus::converged;
  return std::nullopt;
}

GradientSum::GradientSum(const Eigen::Vector3d& speeds, double most)
    : means_{BoundedMean(-most * speeds[0], most * speeds[0]),
             BoundedMean(-most * speeds[1], most * speeds[1]),
             BoundedMean(-most * speeds[2], most * speeds[2])} {}

void GradientSum::add(const Whitening& whitening, const Eigen::Vector3d& y, double weight) {
  const Eigen::Vector3d weighted = whitening.matrix().transpose() * (weight * y);
  for (std::size_t k = 0; k < 3; ++k) means_[k].add(weighted[static_cast<Eigen::Index>(k)]);
}

void GradientSum::report(bool full_rank, std::size_t samples, ProbabilityResult& result) const {
  if (!full_rank) {
    result.plan.push_back("no gradient: P need not be differentiable where A does not move");
    return;
  }
  const auto n = static_cast<double>(samples);
  const Eigen::Vector3d error(means_[0].standardError(n), means_[1].standardError(n),
                              means_[2].standardError(n));
  if (!error.allFinite()) {
    result.plan.push_back("no gradient: so few samples tell nothing of its error");
    return;
  }
  result.gradient = Eigen::Vector3d(means_[0].mean(n), means_[1].mean(n), means_[2].mean(n));
  result.gradient_standard_error = error;
}

}  // namespace fcl_prob::detail
