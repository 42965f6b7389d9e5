// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/obstacle_answer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/decision.h"
#include "fcl_prob/combined_bounds.h"
#include "query/call_budget.h"

namespace fcl_prob::detail {
namespace {

/// By how much the tolerance of a round of a decision is less than that of the one before: every
/// round begins anew, so that the last should take most of the time.
constexpr double kFiner = 1.0 / 16;

/// What rounding leaves of a probability; less is no tolerance.
constexpr double kLeastTolerance = 1e-15;

class EventAnswers {
 public:
  /// \param combine  null: the events are independent
  EventAnswers(std::size_t count, const ProbabilityRequest& request, const AskEvent& ask,
               const CombineEvents* combine, std::vector<Bounds> known = {})
      : request_(request),
        ask_(ask),
        combine_(combine),
        budget_(request),
        bounds_(std::move(known)) {
    bounds_.resize(count, Bounds{0.0, 1.0});
    result_.parts.resize(count);
  }

  RobotResult run() {
    if (request_.threshold && bounds_.size() > 1) {
      ProbabilityRequest share = request_;
      share.threshold = *request_.threshold / static_cast<double>(bounds_.size());
      askAll(share, [&](std::size_t i) { return !(bounds_[i].upper < *share.threshold); });
      if (!combine_) askForWhatIsLeft();
    }
    ProbabilityRequest fine = request_;
    fine.absolute_tolerance /= static_cast<double>(bounds_.size());
    if (bounds_.size() > 1) fine.threshold.reset();
    askFor(fine);
    if (asksForDecision(request_) && bounds_.size() > 1) narrowUntilDecided(fine);
    return finished();
  }

 private:
  static bool isFine(const ProbabilityResult& part, const ProbabilityRequest& request) {
    if (!part.upper) return false;
    if (request.method == ProbabilityMethod::estimate) return false;
    const double width = *part.upper - part.lower.value_or(0.0);
    return width <= request.toleranceAt(*part.upper);
  }

  void askFor(const ProbabilityRequest& fine) {
    askAll(fine, [this, &fine](std::size_t i) { return !isFine(result_.parts[i], fine); });
  }

  /// Rounds with less and less tolerance, until they decide or nothing becomes narrower.
  void narrowUntilDecided(ProbabilityRequest fine) {
    while (!isDecided() && !isOut() && mayBeDecided()) {
      fine.absolute_tolerance *= kFiner;
      fine.relative_tolerance *= kFiner;
      if (fine.relative_tolerance + fine.absolute_tolerance < kLeastTolerance) return;
      const std::vector<Bounds> before = bounds_;
      askFor(fine);
      if (!isNarrowerThan(before) && allAreDone()) return;
    }
  }

  /// Bounds of the events get no farther than to each other.
  bool mayBeDecided() const {
    std::vector<Bounds> least = bounds_, most = bounds_;
    for (std::size_t i = 0; i < bounds_.size(); ++i) {
      least[i].upper = bounds_[i].lower;
      most[i].lower = bounds_[i].upper;
    }
    return detail::isDecided(decisionOf(anyOf(least), request_)) ||
           detail::isDecided(decisionOf(anyOf(most), request_));
  }

  bool isNarrowerThan(const std::vector<Bounds>& before) const {
    for (std::size_t i = 0; i < bounds_.size(); ++i) {
      if (bounds_[i].width() < before[i].width()) return true;
    }
    return false;
  }

  /// Whether no event can become narrower, whatever the tolerance.
  bool allAreDone() const {
    return std::all_of(result_.parts.begin(), result_.parts.end(), [](const auto& part) {
      return part.status == ProbabilityStatus::exact || !isAnswered(part.status);
    });
  }

  Bounds anyOf(const std::vector<Bounds>& events) const {
    return combine_ ? (*combine_)(events) : anyOfIndependent(events);
  }

  template <typename Needed>
  void askAll(const ProbabilityRequest& part, const Needed& is_needed) {
    std::size_t left = 0;
    for (std::size_t i = 0; i < bounds_.size(); ++i) left += is_needed(i);
    for (std::size_t i = 0; i < bounds_.size(); ++i) {
      if (!is_needed(i)) continue;
      if (isDecided() || isOut()) return;
      askOne(i, part, left--);
    }
  }

  bool isOut() {
    if (!stopped_) stopped_ = budget_.exhausted();
    return stopped_.has_value();
  }

  /// \param left  events that are still to be asked for, this one included
  void askOne(std::size_t i, ProbabilityRequest request, std::size_t left) {
    budget_.share(left, request);
    ProbabilityResult answer;
    ask_(i, request, answer);
    budget_.spend(answer.statistics);
    bounds_[i] = {std::max(bounds_[i].lower, answer.lower.value_or(0.0)),
                  std::min(bounds_[i].upper, answer.upper.value_or(1.0))};
    if (isStopped(answer.status)) stopped_ = answer.status;
    result_.parts[i] = std::move(answer);
  }

  /// Of independent events: each against what the upper bounds of the others leave of the
  /// threshold. Where one event has most of it, that decides.
  void askForWhatIsLeft() {
    std::vector<std::size_t> order(bounds_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [this](std::size_t x, std::size_t y) {
      return bounds_[x].width() > bounds_[y].width();
    });
    for (std::size_t k = 0; k < order.size(); ++k) {
      const std::size_t i = order[k];
      ProbabilityRequest part = request_;
      *part.threshold = leftTo(i);
      const bool may_tell =
          *part.threshold > bounds_[i].lower && *part.threshold < bounds_[i].upper;
      if (!may_tell) continue;
      if (isDecided() || isOut()) return;
      askOne(i, part, order.size() - k);
    }
  }

  double leftTo(std::size_t i) const {
    double free = 1.0;
    for (std::size_t j = 0; j < bounds_.size(); ++j) free *= j == i ? 1.0 : 1.0 - bounds_[j].upper;
    return free > 0.0 ? 1.0 - (1.0 - *request_.threshold) / free : 0.0;
  }

  static bool isStopped(ProbabilityStatus status) {
    return status == ProbabilityStatus::cancelled || status == ProbabilityStatus::time_limit;
  }

  bool isDecided() {
    result_.any = anyOf(bounds_);
    result_.decision = decisionOf(result_.any, request_);
    return detail::isDecided(result_.decision);
  }

  RobotResult finished() {
    const bool decided = isDecided();
    if (!combine_) addEstimate();
    result_.status = decided ? ProbabilityStatus::decided : statusOfParts();
    return std::move(result_);
  }

  // Of 1 - Π(1 - e), to first order in the errors, which are independent.
  void addEstimate() {
    for (const ProbabilityResult& part : result_.parts) {
      if (!part.estimate) return;
    }
    double variance = 0.0;
    for (std::size_t i = 0; i < result_.parts.size(); ++i) {
      double others = 1.0;
      for (std::size_t j = 0; j < result_.parts.size(); ++j) {
        if (j != i) others *= 1.0 - *result_.parts[j].estimate;
      }
      variance += std::pow(others * result_.parts[i].standard_error.value_or(0.0), 2);
    }
    double some = 0.0;  // not 1 - Π, which cancels
    double so_far = 1.0;
    for (const ProbabilityResult& part : result_.parts) {
      some += so_far * *part.estimate;
      so_far *= 1.0 - *part.estimate;
    }
    result_.estimate = std::clamp(some, result_.any.lower, result_.any.upper);
    result_.standard_error = std::sqrt(variance);
  }

  ProbabilityStatus statusOfParts() const {
    if (stopped_) return *stopped_;
    ProbabilityStatus common = ProbabilityStatus::exact;
    for (const ProbabilityResult& part : result_.parts) {
      if (!isAnswered(part.status)) return part.status;
      if (part.status != ProbabilityStatus::exact) common = ProbabilityStatus::converged;
    }
    if (common == ProbabilityStatus::exact) return common;
    if (asksForDecision(request_)) return ProbabilityStatus::resolution_limit;
    if (combine_ || isWithinTolerance()) return common;
    return ProbabilityStatus::resolution_limit;
  }

  bool isWithinTolerance() const {
    const bool sampled = result_.estimate && request_.method == ProbabilityMethod::estimate;
    const double error = sampled ? *result_.standard_error : result_.any.width();
    const double size = sampled ? *result_.estimate : result_.any.upper;
    return error <= request_.toleranceAt(size);
  }

  const ProbabilityRequest& request_;
  const AskEvent& ask_;
  const CombineEvents* combine_;
  CallBudget budget_;
  std::vector<Bounds> bounds_;
  RobotResult result_;
  std::optional<ProbabilityStatus> stopped_;
};

}  // namespace

RobotResult anyOfAsked(std::size_t count, const ProbabilityRequest& request, const AskEvent& ask,
                       std::vector<Bounds> known) {
  return EventAnswers(count, request, ask, nullptr, std::move(known)).run();
}

RobotResult anyOfDependent(std::size_t count, const ProbabilityRequest& request,
                           const AskEvent& ask, const CombineEvents& combine) {
  return EventAnswers(count, request, ask, &combine).run();
}

}  // namespace fcl_prob::detail
