// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/configuration_estimate.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/decision.h"
#include "base/quantiles.h"
#include "pose/counting_source.h"
#include "pose/pair_source.h"
#include "pose/query_costs.h"

namespace fcl_prob::detail {
namespace {

// A threshold so many standard errors away is decided.
constexpr double kDecided = 4.0;

/// Whichever source is expected to come to an end first goes on.
class Estimator {
 public:
  Estimator(const RandomConfiguration& configuration, const ConditionalAnswer& answer,
            const GeometryList& a, const GeometryList& b, const ProbabilityRequest& request)
      : request_(request),
        watch_(request),
        pairs_(configuration, answer, queryCost(a, b), request, watch_) {
    if (CountingSource::isFor(configuration, a, b, request)) {
      counting_.emplace(configuration, a, b, request, watch_);
    }
  }

  ProbabilityResult run() {
    EstimateSource* next = cheapestToBegin();
    std::optional<ProbabilityStatus> status;
    do {
      next->draw(request_.toleranceAt(probability_));
      status = look(*next);
      if (status) break;
      next = cheapest();
      if (next == nullptr) status = ProbabilityStatus::resolution_limit;
    } while (!status);
    return resultOf(*status);
  }

 private:
  struct Answer {
    const EstimateSource* source;
    EstimatedMean mean;
    Bounds interval;
  };

  std::optional<ProbabilityStatus> look(const EstimateSource& source) {
    const auto mean = source.mean();
    if (!mean) return watch_.reason();
    probability_ = std::clamp(mean->mean, 0.0, 1.0);
    ++looks_;
    const Answer answer{&source, *mean, intervalAt(looks_, *mean)};
    watch_.setProgress(answer.interval);
    const auto status = source.isAnswer() ? satisfied(answer) : std::nullopt;
    const bool is_best =
        !best_ || best_->source == &source || mean->standard_error < best_->mean.standard_error;
    if (status || is_best) best_ = answer;
    return status ? status : watch_.reason();
  }

  std::optional<ProbabilityStatus> satisfied(const Answer& answer) const {
    const Decision decision = decisionOf(answer.interval, request_);
    if (isDecided(decision)) {
      return ProbabilityStatus::decided;
    }
    if (answer.mean.standard_error <= request_.toleranceAt(probability_)) {
      return ProbabilityStatus::converged;
    }
    return std::nullopt;
  }

  EstimateSource* cheapestToBegin() {
    if (counting_ && counting_->costOfFirst() < pairs_.costOfFirst()) return &*counting_;
    return &pairs_;
  }

  /// Null if no more work helps.
  EstimateSource* cheapest() {
    double needed = request_.toleranceAt(probability_);
    if (request_.threshold) {
      needed = std::max(needed, std::fabs(probability_ - *request_.threshold) / kDecided);
    }
    const double by_pairs = pairs_.costTo(needed, probability_);
    const double by_counting = counting_ ? counting_->costTo(needed, probability_) : kInfinity;
    if (std::min(by_pairs, by_counting) == kInfinity) return nullptr;
    if (by_counting < by_pairs) return &*counting_;
    return &pairs_;
  }

  // The error probabilities of all looks add up to that of the request.
  Bounds intervalAt(int look, const EstimatedMean& mean) const {
    const double error = (1.0 - request_.confidence) * std::ldexp(1.0, -look);
    const double reach = studentQuantileAbove(mean.freedom, 0.5 * error) * mean.standard_error;
    return {std::clamp(mean.mean - reach, 0.0, 1.0), std::clamp(mean.mean + reach, 0.0, 1.0)};
  }

  ProbabilityResult resultOf(ProbabilityStatus status) const {
    ProbabilityResult result;
    result.method = request_.method == ProbabilityMethod::rare_event ? ProbabilityMethod::rare_event
                                                                     : ProbabilityMethod::estimate;
    result.status = status;
    result.lower = 0.0;
    result.upper = 1.0;
    result.statistics = pairs_.statistics();
    result.statistics.seconds.emplace_back("configurations", watch_.seconds());
    result.decision = decisionOf(best_ ? best_->interval : Bounds{0.0, 1.0}, request_);
    if (best_) {
      result.estimate = std::clamp(best_->mean.mean, 0.0, 1.0);
      result.standard_error = best_->mean.standard_error;
      result.confidence_interval = best_->interval;
    }
    const bool by_pairs = !best_ || best_->source == &pairs_;
    if (by_pairs || pairs_.mean()) pairs_.describe(result);
    if (counting_ && counting_->mean()) counting_->describe(result);
    if (!by_pairs) {
      result.plan.push_back("the estimate is that of fcl::collide, which gets there sooner");
    }
    return result;
  }

  const ProbabilityRequest& request_;
  RunWatch watch_;
  PairSource pairs_;
  std::optional<CountingSource> counting_;
  std::optional<Answer> best_;
  double probability_ = 0.0;  ///< by the last look
  int looks_ = 0;
};

}  // namespace

ProbabilityResult configurationEstimate(const RandomConfiguration& configuration,
                                        const ConditionalAnswer& answer, const GeometryList& a,
                                        const GeometryList& b, const ProbabilityRequest& request) {
  return Estimator(configuration, answer, a, b, request).run();
}

}  // namespace fcl_prob::detail
