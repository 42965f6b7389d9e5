// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Plain Monte Carlo: samples that collide or do not, counted.
#pragma once

#include <vector>

#include "base/budget.h"
#include "sampling/sampling_run.h"

namespace fcl_prob::detail {

class CountingRun : public SamplingRun {
 public:
  explicit CountingRun(const ProbabilityRequest& request);

  /// Draws the samples; sets what SamplingRun::run() sets and the estimate, its standard error
  /// (with half a hit added, so that it is not 0 without hits), the hits and the time.
  /// \param budget  made when the call was
  ProbabilityResult result(Budget& budget);

 protected:
  /// Whether sample `index` collides; called on any thread.
  virtual bool collides(std::size_t index) const = 0;

  /// Called for every sample that does, in their order.
  virtual void countHit(std::size_t /*index*/) {}

 private:
  void evaluate(std::size_t index, std::size_t slot) override { collided_[slot] = collides(index); }
  void count(std::size_t index, std::size_t slot) override;
  Bounds interval(double confidence) const override;

  std::vector<unsigned char> collided_;
  std::size_t hits_ = 0;
};

}  // namespace fcl_prob::detail
