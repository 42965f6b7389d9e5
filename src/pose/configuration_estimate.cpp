// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/configuration_estimate.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/constants.h"
#include "base/decision.h"
#include "base/known.h"
#include "pose/counting_source.h"

namespace fcl_prob::detail {
namespace {

// Samples of the first look; and between two looks: stakes and tolerances follow what was seen, but
// a look costs time of its own.
constexpr std::size_t kFirstSamples = 256;
constexpr double kLeastGrowth = 1.1;
constexpr double kMostGrowth = 4.0;

// So many are drawn at most where none says that the tolerance can be reached: the more, the
// smaller the probability that is answered by counting, and the later the answer where it cannot
// be.
constexpr double kMostBlind = 1 << 15;
constexpr double kMostBlindPairs = 1 << 10;

// A mean of fewer configurations than this may be anything.
constexpr double kEnoughSamples = 16.0;

// Drawn beyond what the last look says is needed.
constexpr double kReserve = 1.05;

// Of the chance of error: counting's, where pairs may take its place and have the rest. What
// counting says is then kept, at 2 % more samples than with all of it.
constexpr double kShareOfCounting = 0.9;

// Added to both ends of an interval: what the known mass of a quadric and the sums may be wrong by.
constexpr double kErrorOfSums = 2e-9;

class Estimator {
 public:
  Estimator(const ConfigurationMixture& mixture, const ConditionalAnswer& answer,
            const GeometryList& a, const GeometryList& b, const ProbabilityRequest& request)
      : request_(request), watch_(request), pairs_(mixture, answer, request, watch_) {
    source_ = &pairs_;
    if (!watch_.goOn() || !CountingSource::isFor(mixture, a, b, request)) return;
    counting_ = std::make_unique<CountingSource>(mixture, a, b, request, watch_);
    source_ = counting_.get();
  }

  ProbabilityResult run() {
    std::size_t next = isCounting() ? kFirstSamples : PairSource::kLeastPairs;
    std::optional<ProbabilityStatus> status = watch_.exhausted();
    while (!status) {
      aim();
      source_->drawTo(next, tolerance());
      status = look();
      next = nextCount();
      if (status == ProbabilityStatus::resolution_limit && isCounting() && !request_.threshold) {
        counted_ = interval_;
        source_ = &pairs_;
        next = PairSource::kLeastPairs;
        status = watch_.exhausted();
      }
    }
    if (isCounting() && request_.gradient) drawGradient();
    // Pairs that could not begin take nothing's place.
    if (counting_ && pairs_.samples().count() < 2.0) source_ = counting_.get();
    return resultOf(*status);
  }

 private:
  bool isCounting() const { return source_ == counting_.get(); }

  double probability() const {
    return std::clamp(source_->offset() + source_->samples().mean(), 0.0, 1.0);
  }
  double tolerance() const { return request_.toleranceAt(probability()); }

  // The stakes of the samples to come are to tell P from the threshold, or from about what the
  // interval of an answer ends at.
  void aim() {
    constexpr double kEnds = 3.0;
    const double p = probability(), away = kEnds * tolerance();
    source_->aim(request_.threshold.value_or(p - away), request_.threshold.value_or(p + away));
  }

  double chanceOfError() const {
    const double all = 1.0 - request_.confidence;
    if (!counting_ || request_.threshold) return all;
    return all * (isCounting() ? kShareOfCounting : 1.0 - kShareOfCounting);
  }

  std::optional<ProbabilityStatus> look() {
    const MeanSequence& samples = source_->samples();
    const Bounds bounds = samples.interval(chanceOfError());
    const double by = source_->offset();
    interval_ = {std::clamp(by + bounds.lower - kErrorOfSums, 0.0, 1.0),
                 std::clamp(by + bounds.upper + kErrorOfSums, 0.0, 1.0)};
    interval_ = agreed(interval_, counted_);
    watch_.tell(interval_);
    if (const auto status = satisfied(samples)) return status;
    return watch_.exhausted();
  }

  /// A threshold is satisfied by a decision and by nothing else, a tolerance by the standard error.
  std::optional<ProbabilityStatus> satisfied(const MeanSequence& samples) const {
    if (request_.threshold) {
      if (isDecided(decisionOf(interval_, request_))) return ProbabilityStatus::decided;
      if (isHopeless(samples)) return ProbabilityStatus::resolution_limit;
      return std::nullopt;
    }
    if (samples.standardError() <= tolerance()) return ProbabilityStatus::converged;
    if (isUnreachable(samples)) return ProbabilityStatus::resolution_limit;
    return std::nullopt;
  }

  // With all samples at the end of their range that tells most, capital grows by a factor of
  // 1 / (1 - t) each, t being the distance of the threshold from that end.
  bool isHopeless(const MeanSequence& samples) const {
    const double t = *request_.threshold;
    const double room = probability() < t ? t : 1.0 - t;
    const double fewest = -std::log(0.5 * (1.0 - request_.confidence)) / -std::log1p(-room);
    return fewest > samples.count() + source_->mostSamples();
  }

  // A probability so small cannot be told from what none of the samples shows, not with as many as
  // the limits allow. Calls of fcl::collide then end soon; answers that are made of many
  // configurations end once they are as near together as was asked for.
  bool isUnreachable(const MeanSequence& samples) const {
    const double most = source_->mostSamples();
    if (samples.samplesFor(tolerance()) <= most) return false;
    if (isCounting()) return samples.count() >= std::min(kMostBlind, most);
    if (samples.spreadError() > tolerance()) return false;
    return tellsMuch(samples) || samples.count() >= kMostBlindPairs;
  }

  static bool tellsMuch(const MeanSequence& samples) {
    return samples.effectiveSamples() >= kEnoughSamples;
  }

  std::size_t nextCount() const {
    const MeanSequence& samples = source_->samples();
    const double count = samples.count();
    const double wanted =
        request_.threshold ? count + samples.samplesToTell(*request_.threshold - source_->offset(),
                                                           1.0 - request_.confidence)
                           : samples.samplesFor(tolerance());
    const double next =
        std::clamp(kReserve * wanted, kLeastGrowth * count + 1.0, kMostGrowth * count + 1.0);
    return static_cast<std::size_t>(std::ceil(next));
  }

  // As many pairs as their own spread asks for.
  void drawGradient() {
    std::size_t next = PairSource::kLeastPairs;
    while (!watch_.exhausted()) {
      pairs_.drawTo(next, tolerance());
      const double ratio = pairs_.samples().spreadError() / tolerance();
      if (!(ratio > 1.0)) break;
      const double count = pairs_.samples().count();
      next = static_cast<std::size_t>(
          std::ceil(count * std::clamp(kReserve * ratio * ratio, kLeastGrowth, kMostGrowth)));
    }
  }

  ProbabilityResult resultOf(ProbabilityStatus status) const {
    const MeanSequence& samples = source_->samples();
    ProbabilityResult result;
    result.method = request_.method == ProbabilityMethod::rare_event ? ProbabilityMethod::rare_event
                                                                     : ProbabilityMethod::estimate;
    result.status = status;
    result.lower = 0.0;
    result.upper = 1.0;
    result.decision = decisionOf(interval_, request_);
    const bool unreachable =
        !request_.threshold && status == ProbabilityStatus::resolution_limit && tellsMuch(samples);
    if (samples.count() >= 2.0) {
      result.estimate = probability();
      result.standard_error = unreachable ? samples.spreadError() : samples.standardError();
      result.confidence_interval = interval_;
    }
    result.statistics.seconds.emplace_back("configurations", watch_.seconds());
    if (counting_) counting_->describe(result);
    if (pairs_.samples().count() > 0.0) pairs_.describe(result);
    pairs_.fillGradient(result);
    if (unreachable) {
      result.plan.push_back(
          "the standard error is the spread of the configurations drawn; what none of them shows "
          "is in the confidence interval only, and more of them than max_cells allows would tell");
    }
    return result;
  }

  const ProbabilityRequest& request_;
  Budget watch_;
  PairSource pairs_;
  std::unique_ptr<CountingSource> counting_;
  EstimateSource* source_ = nullptr;
  Bounds interval_{0.0, 1.0};
  Bounds counted_{0.0, 1.0};  ///< what counting said before pairs took its place
};

}  // namespace

ProbabilityResult configurationEstimate(const ConfigurationMixture& mixture,
                                        const ConditionalAnswer& answer, const GeometryList& a,
                                        const GeometryList& b, const ProbabilityRequest& request) {
  return Estimator(mixture, answer, a, b, request).run();
}

}  // namespace fcl_prob::detail
