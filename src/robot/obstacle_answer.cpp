// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/obstacle_answer.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "base/decision.h"
#include "fcl_prob/combined_bounds.h"

namespace fcl_prob::detail {
namespace {

/// Of what a time limit leaves: what asking every event once may use. The rest is for those that it
/// was not enough for.
constexpr double kShareOfFirst = 0.5;

class EventAnswers {
 public:
  EventAnswers(std::vector<Bounds> known, const ProbabilityRequest& request,
               const PartsLoop::Ask& ask, const PartsLoop::Combine& combine, bool independent)
      : request_(request),
        combine_(combine),
        independent_(independent),
        first_(request.time_limit && known.size() > 1 ? kShareOfFirst : 1.0),
        loop_(request, ask, combine, std::move(known)) {
    loop_.endWhen([this] { return isDecided(); });
  }

  RobotResult run() {
    const bool several = bounds().size() > 1;
    ProbabilityRequest fine = request_;
    fine.absolute_tolerance /= static_cast<double>(bounds().size());
    if (several) fine.threshold.reset();
    if (several && request_.threshold) {
      askForDecision();
      if (!isEstimate()) {
        narrowToDecide(fine);
        return finished();
      }
    }
    const PartsLoop::Wanted finely = [this, &fine](std::size_t i) {
      return isFine(loop_.answers()[i], fine) ? std::nullopt : std::make_optional(fine);
    };
    loop_.askEach(finely, first_);
    loop_.endWhen([this] { return isDecided() || isWithinTolerance(); });
    loop_.askAgain(finely);
    return finished();
  }

 private:
  const std::vector<Bounds>& bounds() const { return loop_.bounds(); }
  bool isEstimate() const { return request_.method == ProbabilityMethod::estimate; }
  Bounds any() const { return combine_(bounds()); }
  bool isDecided() const { return detail::isDecided(decisionOf(any(), request_)); }

  static bool isFine(const std::optional<ProbabilityResult>& part,
                     const ProbabilityRequest& request) {
    if (!part || !part->upper) return false;
    if (request.method == ProbabilityMethod::estimate) return false;
    const double width = *part->upper - part->lower.value_or(0.0);
    return width <= request.toleranceAt(*part->upper);
  }

  /// Each event against its share of the threshold. Then, of independent ones, each against what
  /// the others leave of it at most, and what they leave at least: where one event has most of P,
  /// the first tells that it is below and the second that it is above.
  void askForDecision() {
    const double share = *request_.threshold / static_cast<double>(bounds().size());
    askAgainst([share](std::size_t) { return share; });
    if (!independent_) return;
    askAgainst([this](std::size_t i) { return leftTo(i, &Bounds::upper); });
    askAgainst([this](std::size_t i) { return leftTo(i, &Bounds::lower); });
  }

  /// Those that a threshold of theirs may tell something of.
  void askAgainst(const std::function<double(std::size_t)>& threshold) {
    ProbabilityRequest part = request_;
    const PartsLoop::Wanted against = [&](std::size_t i) {
      part.threshold = threshold(i);
      const bool may_tell =
          *part.threshold > bounds()[i].lower && *part.threshold < bounds()[i].upper;
      return may_tell ? std::make_optional(part) : std::nullopt;
    };
    loop_.askEach(against, first_);
  }

  /// \param end  of what is known of the others
  double leftTo(std::size_t i, double Bounds::*end) const {
    double free = 1.0;
    for (std::size_t j = 0; j < bounds().size(); ++j) free *= j == i ? 1.0 : 1.0 - bounds()[j].*end;
    return free > 0.0 ? 1.0 - (1.0 - *request_.threshold) / free : 0.0;
  }

  /// With a threshold only a decision or a limit is the end.
  void narrowToDecide(const ProbabilityRequest& fine) {
    while (mayBeDecided() && loop_.narrowWidest(fine)) {
    }
  }

  /// Not where the threshold is between what the events allow, however exactly they were known.
  bool mayBeDecided() const {
    std::vector<Bounds> least = bounds(), most = bounds();
    for (Bounds& one : least) one.upper = one.lower;
    for (Bounds& one : most) one.lower = one.upper;
    return combine_(least).upper < *request_.threshold ||
           combine_(most).lower > *request_.threshold;
  }

  RobotResult finished() {
    result_.any = any();
    result_.decision = decisionOf(result_.any, request_);
    for (std::size_t i = 0; i < bounds().size(); ++i) result_.parts.push_back(partOf(i));
    if (independent_) addEstimate();
    result_.status =
        detail::isDecided(result_.decision) ? ProbabilityStatus::decided : statusOfParts();
    return std::move(result_);
  }

  ProbabilityResult partOf(std::size_t i) const {
    if (loop_.answers()[i]) return *loop_.answers()[i];
    ProbabilityResult part;
    if (!(bounds()[i].width() < 1.0)) return part;
    part.lower = bounds()[i].lower;
    part.upper = bounds()[i].upper;
    part.plan.push_back("known by bounds only: more was not asked");
    return part;
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

  ProbabilityStatus statusOfParts() {
    if (!asksForDecision(request_) && isWithinTolerance() && isAskedOfAll()) return commonStatus();
    if (loop_.isOut()) return *loop_.out();
    for (const ProbabilityResult& part : result_.parts) {
      if (!isAnswered(part.status)) return part.status;
    }
    const ProbabilityStatus common = commonStatus();
    if (common == ProbabilityStatus::exact) return common;
    if (asksForDecision(request_)) return ProbabilityStatus::resolution_limit;
    if (!independent_) return common;
    return ProbabilityStatus::resolution_limit;
  }

  bool isAskedOfAll() const {
    return std::all_of(loop_.answers().begin(), loop_.answers().end(),
                       [](const auto& answer) { return answer.has_value(); });
  }

  ProbabilityStatus commonStatus() const {
    const bool exact = std::all_of(
        result_.parts.begin(), result_.parts.end(),
        [](const ProbabilityResult& part) { return part.status == ProbabilityStatus::exact; });
    return exact ? ProbabilityStatus::exact : ProbabilityStatus::converged;
  }

  /// Of the whole; without a threshold, which only a decision satisfies, and of independent events.
  bool isWithinTolerance() const {
    if (request_.threshold || !independent_) return false;
    const bool sampled = result_.estimate && isEstimate();
    if (isEstimate() && !sampled) return false;
    const Bounds whole = any();
    const double error = sampled ? *result_.standard_error : whole.width();
    const double size = sampled ? *result_.estimate : whole.upper;
    return error <= request_.toleranceAt(size);
  }

  const ProbabilityRequest& request_;
  const PartsLoop::Combine& combine_;
  const bool independent_;
  const double first_;
  PartsLoop loop_;
  RobotResult result_;
};

}  // namespace

RobotResult anyOfAsked(std::vector<Bounds> known, const ProbabilityRequest& request,
                       const PartsLoop::Ask& ask) {
  const PartsLoop::Combine independent = &anyOfIndependent;
  return EventAnswers(std::move(known), request, ask, independent, true).run();
}

RobotResult anyOfDependent(std::vector<Bounds> known, const ProbabilityRequest& request,
                           const PartsLoop::Ask& ask, const PartsLoop::Combine& combine) {
  return EventAnswers(std::move(known), request, ask, combine, false).run();
}

}  // namespace fcl_prob::detail
