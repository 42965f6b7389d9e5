// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/swept_motion.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/decision.h"
#include "query/call_budget.h"
#include "robot/sum_above.h"

namespace fcl_prob::detail {
namespace {

/// Distances are made smaller so many times at most, and by these factors.
constexpr int kMostRounds = 20;
constexpr double kMostShrunk = 0.125;
constexpr double kLeastShrunk = 0.5;

/// A half that reaches this part of its step, or more, does so by rounding.
constexpr double kMostOfHalf = 0.8;

/// How narrow an interval is asked for while the steps are still long: of P, and of what the last
/// interval says of the next one.
constexpr double kCoarse = 0.1;
constexpr double kShareOfNext = 0.3;

/// Of the tolerance: what the cells may leave open, the rest being that of the steps.
constexpr double kShareOfCells = 0.6;

/// Steps are halved in microseconds; the clock is looked at once in so many.
constexpr std::size_t kStepsBetweenLooks = 1024;

/// Of the memory limit: what the trees of all steps may take.
constexpr double kShareOfTrees = 0.5;

/// The largest standard deviation.
double deviationOf(const GaussianDisplacement& displacement) {
  return displacement.standardDeviations().maxCoeff();
}

double deviationOf(const TruncatedGaussian& displacement) {
  return deviationOf(displacement.gaussian());
}

double deviationOf(const GaussianMixture& displacement) {
  double largest = 0.0;
  for (const auto& component : displacement.components()) {
    largest = std::max(largest, deviationOf(component.displacement));
  }
  return largest;
}

class SweptMotion {
 public:
  SweptMotion(const SweptPath& path, const PreparedGeometries& geometries,
              const PlacedObstacle& obstacle, const Ball& around_obstacle, double most_far,
              const ProbabilityRequest& request)
      : path_(path),
        geometries_(geometries),
        obstacle_(obstacle),
        around_obstacle_(around_obstacle),
        most_far_(most_far),
        request_(request),
        budget_(request),
        near_(path.wholeSteps()) {
    for (SweptBody& step : near_) step.far_upper = farUpper(step);
  }

  SweptAnswer run() {
    double distance = firstDistance();
    for (int round = 0; round < kMostRounds; ++round) {
      const SweptAnswer before = answer_;
      if (!halveTo(distance)) {
        answer_ = before;
        return finished(budget_.exhausted().value_or(ProbabilityStatus::memory_limit));
      }
      const ProbabilityResult answer = ask();
      keep(answer);
      if (const auto status = isEnough()) return finished(*status);
      if (stops(answer.status)) return finished(answer.status);
      if (const auto status = budget_.exhausted()) return finished(*status);
      if (!(answer_.reach > 0.0)) return finished(ofAllSteps(answer.status));
      if (answer_.reach > distance) break;
      distance = answer_.reach * shrunk();
    }
    return finished(ProbabilityStatus::resolution_limit);
  }

 private:
  double farUpper(const SweptBody& step) const {
    return farContactUpper(step.sweep.around, around_obstacle_, obstacle_.displacement);
  }

  /// Within its share of what may be left out.
  bool isFar(const SweptBody& step) const { return step.far_upper <= most_far_ * step.weight; }

  double firstDistance() const {
    const double deviation =
        std::visit([](const auto& one) { return deviationOf(one); }, obstacle_.displacement);
    if (deviation > 0.0) return deviation;
    double longest = 0.0;
    for (const SweptBody& step : near_) longest = std::max(longest, step.sweep.reach);
    return kLeastShrunk * longest;
  }

  /// Half the way is half the reach, but for what rounding adds to it.
  static bool isWorthHalving(const SweptBody& step, const std::vector<SweptBody>& halves) {
    return std::all_of(halves.begin(), halves.end(), [&](const SweptBody& half) {
      return half.sweep.reach < kMostOfHalf * step.sweep.reach;
    });
  }

  /// False if there are more steps than memory or time allows.
  bool halveTo(double distance) {
    std::vector<SweptBody> left = std::move(near_);
    near_.clear();
    answer_.reach = 0.0;
    const double most = kShareOfTrees * static_cast<double>(request_.max_memory);
    double bytes = 0.0;
    for (std::size_t i = 0; !left.empty(); ++i) {
      if (i % kStepsBetweenLooks == 0 && budget_.exhausted()) return false;
      SweptBody step = std::move(left.back());
      left.pop_back();
      if (isFar(step)) {
        ++answer_.far;
        answer_.far_upper = sumAbove(answer_.far_upper, step.far_upper);
        continue;
      }
      if (step.sweep.reach > distance) {
        std::vector<SweptBody> halves = path_.halvesOf(step);
        if (isWorthHalving(step, halves)) {
          for (SweptBody& half : halves) {
            half.far_upper = farUpper(half);
            left.push_back(std::move(half));
          }
          continue;
        }
      }
      bytes += static_cast<double>(memoryOf({step}, geometries_) + sizeof(SweptBody));
      if (bytes > most) return false;
      answer_.reach = std::max(answer_.reach, step.sweep.reach);
      near_.push_back(std::move(step));
    }
    answer_.steps = near_.size();
    return true;
  }

  ProbabilityResult ask() const {
    ProbabilityResult none;
    none.lower = 0.0;
    none.upper = 0.0;
    none.status = ProbabilityStatus::exact;
    if (near_.empty()) return none;
    ProbabilityRequest of_round = request_;
    budget_.share(1, of_round);
    if (answer_.reach > 0.0) {
      of_round.relative_tolerance *= kShareOfCells;
      of_round.absolute_tolerance =
          std::max(kShareOfCells * request_.absolute_tolerance, expected_);
      if (!asked_) of_round.relative_tolerance = std::max(of_round.relative_tolerance, kCoarse);
    }
    return sweptProbability(near_, geometries_, obstacle_, of_round);
  }

  /// The best bounds of all rounds.
  void keep(const ProbabilityResult& answer) {
    budget_.spend(answer.statistics);
    const Bounds before{answer_.result.lower.value_or(0.0), answer_.result.upper.value_or(1.0)};
    const double upper = sumAbove(answer.upper.value_or(1.0), answer_.far_upper);
    ProbabilityStatistics statistics = answer.statistics;
    statistics.cells += answer_.result.statistics.cells;
    statistics.pairs_tested += answer_.result.statistics.pairs_tested;
    answer_.result = answer;
    answer_.result.statistics = std::move(statistics);
    answer_.result.lower = std::max(before.lower, answer.lower.value_or(0.0));
    answer_.result.upper = std::min({before.upper, upper, 1.0});
    asked_ = true;
  }

  Bounds known() const { return {*answer_.result.lower, *answer_.result.upper}; }

  std::optional<ProbabilityStatus> isEnough() {
    answer_.result.decision = decisionOf(known(), request_);
    return satisfied(known(), request_);
  }

  /// A limit that shorter steps do not move.
  static bool stops(ProbabilityStatus status) {
    return !isAnswered(status) && status != ProbabilityStatus::band_limit &&
           status != ProbabilityStatus::resolution_limit;
  }

  /// What is decided without the steps that are far need not be so with them.
  ProbabilityStatus ofAllSteps(ProbabilityStatus of_near) const {
    const bool is_undecided = asksForDecision(request_) && of_near == ProbabilityStatus::decided;
    return is_undecided ? ProbabilityStatus::resolution_limit : of_near;
  }

  /// What steps add to the interval falls between in proportion to their length and to its square.
  double shrunk() {
    const double width = known().width();
    const double wanted = request_.toleranceAt(known().upper);
    const double factor = std::clamp(0.7 * std::sqrt(wanted / width), kMostShrunk, kLeastShrunk);
    expected_ = kShareOfNext * factor * factor * width;
    return factor;
  }

  SweptAnswer finished(ProbabilityStatus status) {
    if (!asked_) {
      answer_.result.lower = 0.0;
      answer_.result.upper = 1.0;
      answer_.result.decision = decisionOf({0.0, 1.0}, request_);
    }
    answer_.result.method = ProbabilityMethod::interval;
    answer_.result.status = status;
    return std::move(answer_);
  }

  const SweptPath& path_;
  const PreparedGeometries& geometries_;
  const PlacedObstacle& obstacle_;
  const Ball& around_obstacle_;
  double most_far_;
  const ProbabilityRequest& request_;
  CallBudget budget_;
  std::vector<SweptBody> near_;
  SweptAnswer answer_;
  double expected_ = 0.0;  ///< a tolerance that the next round can use
  bool asked_ = false;
};

}  // namespace

SweptAnswer sweptMotion(const SweptPath& path, const PreparedGeometries& geometries,
                        const PlacedObstacle& obstacle, const Ball& around_obstacle,
                        double most_far, const ProbabilityRequest& request) {
  return SweptMotion(path, geometries, obstacle, around_obstacle, most_far, request).run();
}

}  // namespace fcl_prob::detail
