// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/configuration_estimate.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <string>

#include "pose/conditional_samples.h"
#include "query/single_collide.h"

namespace fcl_prob::detail {
namespace {

// Pairs of the first look, which says how large P is; of the least answer, whose standard error has
// some degrees of freedom; and of the most that a mean is taken of at all.
constexpr std::size_t kFirstPairs = 4;
constexpr std::size_t kLeastPairs = 32;

// A single answer is as accurate as if so many pairs made up the estimate.
constexpr double kPairsOfAccuracy = 12.0;

// What of the variance single answers may make up where configurations do not vary.
constexpr double kInnerShare = 0.5;

// A single answer need not be much better than the spread over configurations.
constexpr double kInnerDeviation = 0.7;

constexpr double kCoarsest = 0.3;

// Drawn beyond what the last look says is needed.
constexpr double kReserve = 1.1;
constexpr double kMostGrowth = 8.0;

class Estimator {
 public:
  Estimator(const RandomConfiguration& configuration, const ConditionalAnswer& answer,
            const ProbabilityRequest& request)
      : configuration_(configuration),
        request_(request),
        samples_(configuration, answer, request) {}

  ProbabilityResult run() {
    samples_.drawTo(kFirstPairs, firstTolerance());
    std::optional<ProbabilityStatus> status = look();
    for (std::size_t count = kLeastPairs; !status; count = nextCount()) {
      samples_.drawTo(count, nextTolerance());
      status = look();
    }
    return resultOf(*status);
  }

 private:
  double targetAt(double probability) const {
    return request_.toleranceAt(std::max(probability, 0.0));
  }

  double standardError() const {
    // Where P given the configuration may jump, all that were seen being alike says little: as in
    // counting, half a hit is added.
    const double n = 2.0 * static_cast<double>(samples_.pairs().size());
    const double unseen = samples_.mayJump() ? 0.7 / n : 0.0;
    return std::hypot(mean_.standard_error, unseen) + samples_.doubt();
  }

  InnerTolerance firstTolerance() const {
    const double factor = innerFactor();
    return {std::min(kCoarsest, factor * request_.relative_tolerance),
            factor * request_.absolute_tolerance};
  }

  InnerTolerance nextTolerance() const {
    const double target = targetAt(mean_.mean);
    const double by_target = innerFactor() * target;
    // A mean near 0 so far may be that of configurations which all are far away: no answer need be
    // better than what is asked for.
    const double most = std::max(kCoarsest * mean_.mean, kInnerShare * target);
    const double absolute = std::max(std::min(by_target, most), kInnerDeviation * mean_.deviation);
    if (absolute > 0.0) return {0.0, absolute};
    return firstTolerance();
  }

  static double innerFactor() { return std::sqrt(kInnerShare * 2.0 * kPairsOfAccuracy); }

  std::size_t nextCount() const {
    const auto n = static_cast<double>(samples_.pairs().size());
    const double ratio = standardError() / targetAt(mean_.mean);
    const double wanted = kReserve * n * ratio * ratio;
    const double most = kMostGrowth * n;
    return static_cast<std::size_t>(std::ceil(std::clamp(wanted, n + 2.0, most)));
  }

  std::optional<ProbabilityStatus> look() {
    const std::size_t count = samples_.pairs().size();
    if (count >= kFirstPairs) {
      mean_ = meanOfPairs(samples_.pairs());
      ++looks_;
      interval_ = intervalAt(looks_);
      samples_.setProgress(interval_);
    }
    if (count >= kLeastPairs) {
      const Decision decision = decisionOf(interval_, request_);
      if (decision == Decision::below || decision == Decision::above) {
        return ProbabilityStatus::decided;
      }
      if (standardError() <= targetAt(mean_.mean)) return ProbabilityStatus::converged;
    }
    if (const auto reason = samples_.reason()) return reason;
    if (count < kLeastPairs) return std::nullopt;
    // No number of configurations makes up for what their answers leave open.
    if (samples_.doubt() > targetAt(mean_.mean)) return ProbabilityStatus::resolution_limit;
    return std::nullopt;
  }

  // The error probabilities of all looks add up to that of the request.
  Bounds intervalAt(int look) const {
    const double error = (1.0 - request_.confidence) * std::ldexp(1.0, -look);
    const boost::math::students_t distribution(mean_.freedom);
    const double quantile =
        boost::math::quantile(boost::math::complement(distribution, 0.5 * error));
    const double reach = quantile * standardError();
    return {std::clamp(mean_.mean - reach, 0.0, 1.0), std::clamp(mean_.mean + reach, 0.0, 1.0)};
  }

  ProbabilityResult resultOf(ProbabilityStatus status) const {
    ProbabilityResult result;
    result.method = request_.method == ProbabilityMethod::rare_event ? ProbabilityMethod::rare_event
                                                                     : ProbabilityMethod::estimate;
    result.status = status;
    result.lower = 0.0;
    result.upper = 1.0;
    result.statistics = samples_.statistics();
    result.statistics.seconds.emplace_back("configurations", samples_.seconds());
    if (looks_ > 0) {
      result.estimate = std::clamp(mean_.mean, 0.0, 1.0);
      result.standard_error = standardError();
      result.confidence_interval = interval_;
      samples_.fillGradient(result);
    }
    result.decision = decisionOf(interval_, request_);
    result.plan.push_back(
        std::to_string(2 * samples_.pairs().size()) + " configurations of " +
        std::to_string(configuration_.dimension()) + " dimensions in antithetic pairs, " +
        (mean_.quadratic ? "with a quadratic control variate" : "without a control variate"));
    if (samples_.mayJump()) {
      result.plan.push_back(
          "given the configuration, A does not move along every axis: P may jump from one to the "
          "next");
    }
    return result;
  }

  const RandomConfiguration& configuration_;
  const ProbabilityRequest& request_;
  ConditionalSamples samples_;
  EstimatedMean mean_;
  Bounds interval_{0.0, 1.0};
  int looks_ = 0;
};

}  // namespace

ProbabilityResult configurationEstimate(const RandomConfiguration& configuration,
                                        const ConditionalAnswer& answer,
                                        const ProbabilityRequest& request) {
  return Estimator(configuration, answer, request).run();
}

}  // namespace fcl_prob::detail
