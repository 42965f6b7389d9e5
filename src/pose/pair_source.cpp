// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/pair_source.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

// Pairs of the first look, which says how large P is; and of the least answer, whose standard error
// then has some degrees of freedom.
constexpr std::size_t kFirstPairs = 4;
constexpr std::size_t kLeastPairs = 32;

// So many are expected to be needed before any are drawn.
constexpr double kExpectedPairs = 64.0;

// A single answer is as accurate as if so many pairs made up the estimate.
constexpr double kPairsOfAccuracy = 32.0;

// What of the variance single answers may make up where configurations do not vary.
constexpr double kInnerShare = 0.5;

// A single answer need not be much better than the spread over configurations.
constexpr double kInnerDeviation = 0.7;

constexpr double kCoarsest = 0.3;

// The fit of squares and products is expected to divide the variance over configurations by so
// much.
constexpr double kExpectedOfFit = 16.0;

// Drawn beyond what the last look says is needed.
constexpr double kReserve = 1.1;
constexpr double kMostGrowth = 8.0;

// Microseconds that answers were seen to take, for each of what they count.
constexpr double kCostOfPairTest = 0.2;
constexpr double kCostOfSample = 2.0;

double innerFactor() { return std::sqrt(kInnerShare * 2.0 * kPairsOfAccuracy); }

}  // namespace

PairSource::PairSource(const RandomConfiguration& configuration, const ConditionalAnswer& answer,
                       const QueryCost& cost, const ProbabilityRequest& request, RunWatch& watch)
    : configuration_(configuration),
      cost_(cost),
      request_(request),
      samples_(configuration, answer, request, watch) {}

bool PairSource::isAnswer() const { return samples_.pairs().size() >= kLeastPairs; }

void PairSource::draw(double standard_error) {
  const std::size_t before = samples_.pairs().size();
  if (before < kFirstPairs) {
    samples_.drawTo(kFirstPairs, firstTolerance());
  } else if (before < kLeastPairs) {
    samples_.drawTo(kLeastPairs, nextTolerance(standard_error));
  } else {
    const double wanted = kReserve * pairsTo(standard_error);
    const double next = std::ceil(std::clamp(wanted, count() + 2.0, kMostGrowth * count()));
    samples_.drawTo(static_cast<std::size_t>(next), nextTolerance(standard_error));
  }
  if (samples_.pairs().size() < kFirstPairs) return;
  mean_ = meanOfPairs(samples_.pairs());
  // Where P given the configuration may jump, all that were seen being alike says little: as in
  // counting, half a hit is added.
  const double unseen = samples_.mayJump() ? 0.35 / count() : 0.0;
  mean_->standard_error = std::hypot(mean_->standard_error, unseen) + samples_.doubt();
}

InnerTolerance PairSource::firstTolerance() const {
  const double factor = innerFactor();
  return {std::min(kCoarsest, factor * request_.relative_tolerance),
          factor * request_.absolute_tolerance};
}

InnerTolerance PairSource::nextTolerance(double standard_error) const {
  // A mean near 0 so far may be that of configurations which all are far away: no answer need be
  // better than what is asked for.
  const double most = std::max(kCoarsest * mean_->mean, kInnerShare * standard_error);
  const double absolute =
      std::max(std::min(innerFactor() * standard_error, most), kInnerDeviation * mean_->deviation);
  if (absolute > 0.0) return {0.0, absolute};
  return firstTolerance();
}

double PairSource::pairsTo(double standard_error) const {
  const double ratio = mean_->standard_error / standard_error;
  return count() * ratio * ratio;
}

// What few pairs show of the spread will be less by what is fitted later.
double PairSource::pairsAtFirst(double standard_error) const {
  if (!mean_) return kExpectedPairs;
  return std::max(static_cast<double>(kLeastPairs), pairsTo(standard_error) / kExpectedOfFit);
}

double PairSource::costOfAnswer() const {
  if (!mean_) return cost_.least + cost_.rough;
  const ProbabilityStatistics& sum = samples_.statistics();
  const double counted = kCostOfPairTest * static_cast<double>(sum.pairs_tested) +
                         kCostOfSample * static_cast<double>(sum.samples);
  return cost_.least + counted / (2.0 * count());
}

double PairSource::costOfFirst() const {
  return 2.0 * static_cast<double>(kFirstPairs) * costOfAnswer();
}

double PairSource::costTo(double standard_error, double /*probability*/) const {
  // No number of configurations makes up for what their answers leave open.
  if (isAnswer() && samples_.doubt() > standard_error) return kInfinity;
  const double wanted = isAnswer() ? pairsTo(standard_error) : pairsAtFirst(standard_error);
  return 2.0 * std::max(0.0, wanted - count()) * costOfAnswer();
}

void PairSource::describe(ProbabilityResult& result) const {
  if (mean_) samples_.fillGradient(result);
  result.plan.push_back(std::to_string(2 * samples_.pairs().size()) + " configurations of " +
                        std::to_string(configuration_.dimension()) +
                        " dimensions in antithetic pairs, " +
                        (mean_ && mean_->quadratic ? "with a quadratic control variate"
                                                   : "without a control variate"));
  if (samples_.mayJump()) {
    result.plan.push_back(
        "given the configuration, A does not move along every axis: P may jump from one to the "
        "next");
  }
}

}  // namespace fcl_prob::detail
