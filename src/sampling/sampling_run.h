// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What all sampling methods have in common: drawing samples until something says stop.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "base/budget.h"
#include "base/decision.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"
#include "fcl_prob/whitening.h"
#include "gaussian/bounded_mean.h"
#include "sampling/confidence.h"
#include "sampling/sample_loop.h"

namespace fcl_prob::detail {

/// Draws samples 0, 1, 2, ... on the threads asked for and counts them in that order, so that sums
/// do not depend on how the samples were divided among threads.
class SamplingRun {
 public:
  /// \param samples  at most so many
  /// \param absolute_tolerance  half-width of the interval at which to stop, if the relative one
  /// does not
  SamplingRun(const ProbabilityRequest& request, std::size_t samples, double absolute_tolerance);
  virtual ~SamplingRun() = default;

  /// Sets confidence_interval, decision and status, and statistics.samples.
  ProbabilityResult run(Budget& budget);

  /// What came before has met a limit already: run() then draws as few samples as make an answer.
  void interrupt(ProbabilityStatus reason) { interruption_ = reason; }

 protected:
  static constexpr std::size_t kSlots = SampleLoop::kLargestChunk;

  /// Evaluates a sample into its slot; called on any thread, no slot by two at once.
  virtual void evaluate(std::size_t index, std::size_t slot) = 0;

  /// Adds a sample to the sums; called in the order of the samples.
  virtual void count(std::size_t index, std::size_t slot) = 0;

  /// Confidence interval from the samples counted so far.
  virtual Bounds interval(double confidence) const = 0;

  std::size_t counted() const { return counted_; }

 private:
  bool countUpTo(std::size_t done, Budget& budget);
  std::optional<ProbabilityStatus> reasonToStop(const Bounds& interval) const;

  const ProbabilityRequest& request_;
  std::size_t samples_;
  double absolute_tolerance_;
  LookSchedule looks_;
  SampleLoop loop_;
  std::size_t counted_ = 0;
  std::optional<ProbabilityStatus> interruption_;
};

/// The gradient of P with respect to the mean from samples `y` of the whitened frame:
/// ∂P/∂mean = Wᵀ E[y 1_V(y)].
class GradientSum {
 public:
  /// \param speeds  no less than the lengths of the columns of W, of each displacement
  /// \param most    no less than |m·y| of a hit times its weight, for unit vectors m, but for what
  ///                is nothing beside the rest of the gradient
  GradientSum(const Eigen::Vector3d& speeds, double most);

  /// Adds a hit at `y` (standard normal coordinates along the axes of the displacement) of this
  /// weight.
  void add(const Whitening& whitening, const Eigen::Vector3d& y, double weight);

  /// Sets the gradient and its standard error after `samples` samples, or says in the plan why not.
  /// \param full_rank  of all displacements
  void report(bool full_rank, std::size_t samples, ProbabilityResult& result) const;

 private:
  std::array<BoundedMean, 3> means_;  ///< 1/metres, world frame
};

}  // namespace fcl_prob::detail
