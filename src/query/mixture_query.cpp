// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/mixture_query.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/constants.h"
#include "base/decision.h"
#include "base/random_words.h"
#include "query/parts_loop.h"
#include "query/plan_notes.h"

namespace fcl_prob::detail {
namespace {

/// The first look at every component, to see which of them matter.
constexpr double kCoarse = 0.3;

/// Of the limits: what that may use.
constexpr double kShareOfCoarse = 0.5;

/// How often components are asked again whose standard errors do not add up to what was asked for.
constexpr int kMostRounds = 4;

/// By how much the tolerance of a round of a decision is less than that of the one before: every
/// round begins anew, so that the last should take most of the time.
constexpr double kLeastFiner = 1.0 / 4, kMostFiner = 1.0 / 64;

/// Of the sum: what rounding leaves of it, whatever the tolerance.
constexpr double kRounded = 1e-14;

bool isEstimate(const ProbabilityRequest& request) {
  return request.method == ProbabilityMethod::estimate;
}

bool isOfRareEvents(const ProbabilityRequest& request) {
  return request.method == ProbabilityMethod::rare_event;
}

/// Methods with a tolerance for what they answer of each component.
bool looksTwice(const ProbabilityRequest& request) {
  return request.method == ProbabilityMethod::automatic ||
         request.method == ProbabilityMethod::interval || isEstimate(request);
}

/// Whether a sum is as accurate as was asked for.
bool isGoodEnough(const ProbabilityResult& total, const ProbabilityRequest& request) {
  if (asksForDecision(request)) return false;
  const auto within = [&request](double error, double probability, double absolute) {
    return error <= std::max(absolute, request.relative_tolerance * probability);
  };
  if (isOfRareEvents(request)) {
    const Bounds& sampled = *total.confidence_interval;
    return within(0.5 * sampled.width(), sampled.upper, 0.0);
  }
  if (isEstimate(request)) {
    return within(*total.standard_error, *total.estimate, request.absolute_tolerance);
  }
  return total.lower && total.upper &&
         within(*total.upper - *total.lower, *total.upper, request.absolute_tolerance);
}

std::vector<double> weightsOf(const std::vector<GaussianMixture::Component>& components) {
  std::vector<double> weights;
  for (const auto& component : components) weights.push_back(component.weight);
  return weights;
}

class MixtureQuery {
 public:
  MixtureQuery(const GaussianMixture& mixture, const ProbabilityRequest& request,
               const GaussianQuery& query)
      : components_(mixture.components()),
        request_(request),
        query_(query),
        ask_([this](std::size_t i, const ProbabilityRequest& of_one) {
          // Else what is off of similar components would be off together, and not evened out.
          ProbabilityRequest apart = of_one;
          apart.seed += i * kSeedsApart;
          return query_(components_[i].displacement, apart);
        }),
        combine_([this](const std::vector<Bounds>& parts) {
          return weightedSum([&](std::size_t i) { return parts[i]; });
        }),
        loop_(request, ask_, combine_, std::vector<Bounds>(components_.size(), Bounds{0.0, 1.0}),
              weightsOf(components_)) {
    loop_.endWhen([this] { return decided(); });
  }

  ProbabilityResult answer() {
    if (components_.size() == 1) {
      ProbabilityResult result = query_(components_[0].displacement, request_);
      result.plan.insert(result.plan.begin(), "mixture of 1 Gaussian");
      return result;
    }
    if (looksTwice(request_)) askCoarsely();
    for (int round = 0; round == 0 || (round < kMostRounds && isEstimateTooCoarse()); ++round) {
      askFinely(toleranceOfOne() / (1 << round));
    }
    if (asksForDecision(request_) && looksTwice(request_)) decide();
    return sum();
  }

 private:
  /// The best of each component.
  const std::vector<std::optional<ProbabilityResult>>& results() const { return loop_.answers(); }

  void askCoarsely() {
    ProbabilityRequest coarse = ofOne();
    coarse.relative_tolerance = std::max(kCoarse, request_.relative_tolerance);
    coarse.gradient = false;
    loop_.askEach([&](std::size_t) { return coarse; }, kShareOfCoarse);
  }

  /// Rounds with less and less tolerance, until the sum decides or none of it becomes narrower.
  void decide() {
    double tolerance = toleranceOfOne();
    while (!finished()) {
      const Bounds now = interval();
      const double to_threshold = std::fabs(now.middle() - *request_.threshold);
      tolerance *= std::clamp(to_threshold / tolerance, kMostFiner, kLeastFiner);
      if (!(tolerance > kRounded * now.upper)) return;
      askFinely(tolerance);
      if (!(interval().width() < now.width()) && allAreDone()) return;
    }
  }

  /// Whether no component can become narrower, whatever the tolerance.
  bool allAreDone() const {
    return all([](const auto& one) {
      return one.status == ProbabilityStatus::exact || !isAnswered(one.status);
    });
  }

  /// \param tolerance  of each, where it has one
  void askFinely(double tolerance) {
    ProbabilityRequest fine = ofOne();
    if (looksTwice(request_)) {
      fine.absolute_tolerance = tolerance;
      fine.relative_tolerance = fine.absolute_tolerance > 0.0 ? 0.0 : request_.relative_tolerance;
    }
    const PartsLoop::Wanted finely = [&](std::size_t i) {
      return isFine(i, fine) ? std::nullopt : std::make_optional(fine);
    };
    loop_.askEach(finely);
    loop_.askAgain(finely);
  }

  /// Such that what all components leave open adds up to no more than the tolerance: widths by
  /// their weights, standard errors (independent of each other) by the squares of those.
  double toleranceOfOne() const {
    if (!isEstimate(request_)) {
      return request_.toleranceAt(interval().lower);
    }
    constexpr double kReserve = 0.9;  // for an estimate that turns out smaller
    double squares = 0.0;
    for (const auto& component : components_) squares += component.weight * component.weight;
    const double estimate = estimateOfAll().first;
    return request_.toleranceAt(kReserve * estimate) / std::sqrt(squares);
  }

  /// The threshold is that of the sum. The error probabilities of confidence intervals add up to
  /// that of their sum.
  ProbabilityRequest ofOne() const {
    ProbabilityRequest request = request_;
    request.threshold.reset();
    const double error = (1.0 - request_.confidence) / static_cast<double>(components_.size());
    if (isOfRareEvents(request_)) request.confidence = std::min(1.0 - error, 1.0 - 0x1p-53);
    if (isOfRareEvents(request_) && request_.threshold) {
      request.relative_tolerance = 0.0;
      request.absolute_tolerance = std::numeric_limits<double>::min();
    }
    return request;
  }

  /// The answer so far is good enough.
  bool isFine(std::size_t i, const ProbabilityRequest& fine) const {
    const auto& result = results()[i];
    if (!result || !looksTwice(request_) || request_.gradient) return false;
    if (isEstimate(request_)) return errorOf(i) <= fine.absolute_tolerance;
    return result->lower && result->upper &&
           *result->upper - *result->lower <= fine.absolute_tolerance;
  }

  bool finished() { return loop_.isOut() || decided(); }

  bool decided() const {
    return !isOfRareEvents(request_) && isDecided(decisionOf(interval(), request_));
  }

  template <typename BoundsOf>
  Bounds weightedSum(const BoundsOf& boundsOf) const {
    Bounds sum;
    for (std::size_t i = 0; i < components_.size(); ++i) {
      const Bounds one = boundsOf(i);
      sum.lower += components_[i].weight * one.lower;
      sum.upper += components_[i].weight * one.upper;
    }
    const double rounding = (4.0 + 2.0 * static_cast<double>(components_.size())) * kEpsilon;
    return {std::max(0.0, sum.lower * (1.0 - rounding) - kUnderflow),
            std::min(1.0, sum.upper * (1.0 + rounding) + std::numeric_limits<double>::min())};
  }

  Bounds interval() const { return combine_(loop_.bounds()); }

  /// What is certain of a component needs no confidence.
  Bounds confidenceInterval() const {
    return weightedSum([this](std::size_t i) {
      const auto& one = results()[i];
      return one && one->confidence_interval ? *one->confidence_interval : loop_.bounds()[i];
    });
  }

  /// Of a component that was not estimated: half of what is possible of it.
  double errorOf(std::size_t i) const {
    const auto& one = results()[i];
    if (one && one->estimate) return one->standard_error.value_or(0.0);
    return one ? 0.5 * (one->upper.value_or(1.0) - one->lower.value_or(0.0)) : 0.5;
  }

  std::pair<double, double> estimateOfAll() const {
    double estimate = 0.0, variance = 0.0;
    for (std::size_t i = 0; i < components_.size(); ++i) {
      const auto& one = results()[i];
      const double weight = components_[i].weight;
      const double middle = one ? 0.5 * (one->lower.value_or(0.0) + one->upper.value_or(1.0)) : 0.5;
      estimate += weight * (one && one->estimate ? *one->estimate : middle);
      variance += std::pow(weight * errorOf(i), 2);
    }
    return {estimate, std::sqrt(variance)};
  }

  bool isEstimateTooCoarse() {
    if (!isEstimate(request_) || loop_.isOut() || decided()) return false;
    const auto [estimate, error] = estimateOfAll();
    return error > request_.toleranceAt(estimate);
  }

  bool all(const std::function<bool(const ProbabilityResult&)>& has) const {
    return std::all_of(results().begin(), results().end(),
                       [&has](const auto& result) { return result && has(*result); });
  }

  ProbabilityResult sum() {
    const bool stopped = loop_.isOut() || decided();
    ProbabilityResult total;
    const Bounds bounds = interval();
    if (isOfRareEvents(request_)) {
      total.confidence_interval = confidenceInterval();
    } else {
      if (stopped || all([](const auto& one) { return one.lower.has_value(); }))
        total.lower = bounds.lower;
      if (stopped || all([](const auto& one) { return one.upper.has_value(); }))
        total.upper = bounds.upper;
    }
    const bool estimates = all([](const auto& one) { return one.estimate.has_value(); });
    if (isEstimate(request_) || isOfRareEvents(request_) || estimates) {
      std::tie(total.estimate, total.standard_error) = estimateOfAll();
      if (total.lower) total.estimate = std::clamp(*total.estimate, bounds.lower, bounds.upper);
    }
    if (all([](const auto& one) { return one.gradient.has_value(); })) addGradients(total);
    for (const auto& one : results()) {
      if (!one) continue;
      addStatistics(one->statistics, total.statistics);
      total.statistics.cells_open += one->statistics.cells_open;
    }
    total.method = results()[0] ? results()[0]->method : request_.method;
    total.decision = decisionOf(total.confidence_interval.value_or(bounds), request_);
    total.status = statusOf(total);
    total.plan.push_back("mixture of " + std::to_string(components_.size()) +
                         " Gaussians: the sum of their answers by weight");
    if (request_.gradient && !total.gradient) {
      total.plan.push_back("no gradient: not every component has one");
    }
    noteTolerance(request_, total);
    return total;
  }

  /// Of the components if they agree; else the first that was stopped, unless the sum is good
  /// enough all the same.
  ProbabilityStatus statusOf(const ProbabilityResult& total) const {
    if (isDecided(total.decision)) return ProbabilityStatus::decided;
    if (loop_.out() == ProbabilityStatus::cancelled) return ProbabilityStatus::cancelled;
    const bool fine = isGoodEnough(total, request_);
    if (loop_.out() && !fine) return *loop_.out();
    std::optional<ProbabilityStatus> common;
    for (const auto& result : results()) {
      if (!result) return ProbabilityStatus::converged;
      const bool complete = result->status == ProbabilityStatus::exact ||
                            result->status == ProbabilityStatus::converged;
      if (!complete) return fine ? ProbabilityStatus::converged : result->status;
      if (common && *common != result->status) common = ProbabilityStatus::converged;
      if (!common) common = result->status;
    }
    // Bounds below the least normal double add up to more than their parts.
    const bool has_both = total.lower && total.upper;
    const bool claims_tolerance =
        isEstimate(request_) || asksForDecision(request_) || (looksTwice(request_) && has_both);
    if (claims_tolerance && !fine && *common != ProbabilityStatus::exact)
      return ProbabilityStatus::resolution_limit;
    return *common;
  }

  void addGradients(ProbabilityResult& total) const {
    const bool bounded = all([](const auto& one) { return one.gradient_lower.has_value(); });
    const bool sampled =
        all([](const auto& one) { return one.gradient_standard_error.has_value(); });
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    Eigen::Vector3d lower = middle, upper = middle, size = middle, variance = middle;
    for (std::size_t i = 0; i < components_.size(); ++i) {
      const double weight = components_[i].weight;
      const ProbabilityResult& one = *results()[i];
      middle += weight * *one.gradient;
      if (sampled) variance += (weight * *one.gradient_standard_error).cwiseAbs2();
      if (!bounded) continue;
      lower += weight * *one.gradient_lower;
      upper += weight * *one.gradient_upper;
      size += weight * one.gradient_lower->cwiseAbs().cwiseMax(one.gradient_upper->cwiseAbs());
    }
    total.gradient = middle;
    if (sampled) total.gradient_standard_error = variance.cwiseSqrt();
    if (!bounded) return;
    size *= (4.0 + 2.0 * static_cast<double>(components_.size())) * kEpsilon;
    total.gradient_lower = lower - size;
    total.gradient_upper = upper + size;
  }

  const std::vector<GaussianMixture::Component>& components_;
  const ProbabilityRequest& request_;
  const GaussianQuery& query_;
  const PartsLoop::Ask ask_;
  const PartsLoop::Combine combine_;
  PartsLoop loop_;
};

}  // namespace

ProbabilityResult mixtureProbability(const GaussianMixture& mixture,
                                     const ProbabilityRequest& request,
                                     const GaussianQuery& query) {
  return MixtureQuery(mixture, request, query).answer();
}

}  // namespace fcl_prob::detail
