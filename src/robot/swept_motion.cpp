// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/swept_motion.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "base/decision.h"
#include "base/known.h"
#include "base/rounded_sum.h"
#include "query/parts_loop.h"

namespace fcl_prob::detail {
namespace {

/// Distances are made smaller so many times at most, and by these factors.
constexpr int kMostRounds = 40;
constexpr double kMostShrunk = 0.25;
constexpr double kLeastShrunk = 0.5;

/// How narrow an interval is asked for while the steps are still long: of P, and of what the last
/// interval says of the next one.
constexpr double kCoarse = 0.1;
constexpr double kShareOfNext = 0.3;

/// Of the tolerance: what the cells of each of the two questions may leave open, the rest being
/// that of the steps.
constexpr double kShareOfCells = 0.3;

/// Steps are halved in microseconds; the clock is looked at once in so many.
constexpr std::size_t kStepsBetweenLooks = 1024;

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
  SweptMotion(const SweptPath& path, const ObstacleAmongBodies& scene, const ObstacleState& state,
              double most_far, const Bounds& known, const ProbabilityRequest& request)
      : path_(path),
        scene_(scene),
        state_(state),
        around_obstacle_(scene.obstacle.around().placed(state.pose)),
        most_far_(most_far),
        request_(request),
        budget_(request),
        known_(known) {
    answer_.result.method = ProbabilityMethod::interval;
  }

  SweptAnswer run() {
    for (SweptBody& step : path_.wholeSteps()) add(std::move(step));
    double distance = firstDistance();
    for (int round = 0; round < kMostRounds; ++round) {
      const bool has_room = halveTo(distance);
      if (const auto status = budget_.exhausted()) return finished(*status);
      const std::vector<SweptBody> steps = takeSteps();
      ProbabilityStatus status = askSweeps(steps);
      if (isEnough()) return finished(*isEnough());
      const ProbabilityStatus of_ends = askEnds(steps);
      if (!stops(status)) status = of_ends;
      if (isEnough()) return finished(*isEnough());
      if (stops(status)) return finished(status);
      if (const auto limit = budget_.exhausted()) return finished(*limit);
      if (!(answer_.reach > 0.0)) return finished(ofAllSteps(status));
      if (!has_room) return finished(ProbabilityStatus::memory_limit);
      if (answer_.reach > distance) break;
      distance = answer_.reach * shrunk();
    }
    return finished(ProbabilityStatus::resolution_limit);
  }

 private:
  static bool isShorter(const SweptBody& x, const SweptBody& y) {
    return x.sweep.reach < y.sweep.reach;
  }

  /// Within its share of what may be left out.
  bool isFar(const SweptBody& step) const { return step.far_upper <= most_far_ * step.weight; }

  std::size_t bytesOf(const SweptBody& step) const {
    return treeMemory(*scene_.robot.geometries[step.body]) + sizeof(SweptBody);
  }

  /// To the steps that are to be halved, the longest first, unless it is far.
  void add(SweptBody step) {
    step.far_upper = farContactUpper(step.sweep.around, around_obstacle_, state_.displacement);
    if (isFar(step)) {
      far_ += path_.statesIn(step);
      far_upper_ = sumAbove(far_upper_, step.far_upper);
      return;
    }
    bytes_ += bytesOf(step);
    near_.push_back(std::move(step));
    std::push_heap(near_.begin(), near_.end(), isShorter);
  }

  double firstDistance() const {
    const double deviation =
        std::visit([](const auto& one) { return deviationOf(one); }, state_.displacement);
    if (deviation > 0.0) return deviation;
    return near_.empty() ? 0.0 : kLeastShrunk * near_.front().sweep.reach;
  }

  /// Halves the longest steps. \return  false if memory is full before all are short enough
  bool halveTo(double distance) {
    const std::size_t most = mostTreeMemory(request_);
    for (std::size_t i = 0; !near_.empty() && near_.front().sweep.reach > distance; ++i) {
      if (i % kStepsBetweenLooks == 0 && budget_.exhausted()) return false;
      if (bytes_ + bytesOf(near_.front()) > most) return false;
      std::pop_heap(near_.begin(), near_.end(), isShorter);
      SweptBody step = std::move(near_.back());
      near_.pop_back();
      std::vector<SweptBody> halves = path_.halvesOf(step);
      if (halves.empty()) {
        shortest_.push_back(std::move(step));
        continue;
      }
      bytes_ -= bytesOf(step);
      for (SweptBody& half : halves) add(std::move(half));
    }
    return true;
  }

  /// All that are not far, body by body along the motion.
  std::vector<SweptBody> takeSteps() {
    std::vector<SweptBody> steps = shortest_;
    steps.insert(steps.end(), near_.begin(), near_.end());
    std::sort(steps.begin(), steps.end(), [](const SweptBody& x, const SweptBody& y) {
      return std::make_pair(x.body, x.first) < std::make_pair(y.body, y.first);
    });
    answer_.steps = steps.size();
    answer_.reach = 0.0;
    for (const SweptBody& step : steps) answer_.reach = std::max(answer_.reach, step.sweep.reach);
    answer_.far = far_;
    answer_.far_upper = far_upper_;
    return steps;
  }

  /// What bounds P from above; nothing where no step is longer than a point.
  ProbabilityStatus askSweeps(const std::vector<SweptBody>& steps) {
    if (!(answer_.reach > 0.0)) return ProbabilityStatus::converged;
    ProbabilityRequest of_round = requestOfRound(2);
    watch(of_round, [this](const Bounds& of_near) { return Bounds{0.0, withFar(of_near.upper)}; });
    const PlacedObstacle obstacle{scene_.obstacle, state_.pose, state_.displacement};
    const ProbabilityResult answer =
        sweptProbability(steps, scene_.robot.geometries, obstacle, of_round);
    keep(answer, {0.0, withFar(answer.upper.value_or(1.0))});
    return answer.status;
  }

  /// Where bodies are at the ends of their steps, of which most begin where others end.
  std::vector<PlacedBody> endsOf(const std::vector<SweptBody>& steps) const {
    std::vector<PlacedBody> ends;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const auto& [body, first, last] = std::tie(steps[i].body, steps[i].first, steps[i].last);
      ends.push_back(path_.at(body, first));
      const bool goes_on =
          i + 1 < steps.size() && steps[i + 1].body == body && steps[i + 1].first <= last + 1.0;
      if (!goes_on && last > first) ends.push_back(path_.at(body, last));
    }
    return ends;
  }

  /// What bounds P from below, or tells it, where no step is longer than a point.
  ProbabilityStatus askEnds(const std::vector<SweptBody>& steps) {
    std::vector<PlacedBody> ends = endsOf(steps);
    const double far = leaveOutUnlikely(scene_, state_, most_far_, ends);
    const bool is_all = !(answer_.reach > 0.0);
    const auto boundsOf = [this, is_all, far](const Bounds& of_near) {
      return Bounds{of_near.lower, is_all ? withFar(sumAbove(of_near.upper, far)) : 1.0};
    };
    ProbabilityRequest of_round = requestOfRound(1);
    watch(of_round, boundsOf);
    FarBodies left_out;
    const ProbabilityResult answer =
        placedProbability(scene_, state_, std::move(ends), of_round, left_out);
    keep(answer, boundsOf({answer.lower.value_or(0.0), answer.upper.value_or(1.0)}));
    return answer.status;
  }

  /// \param parts  questions of the round that are left
  ProbabilityRequest requestOfRound(std::size_t parts) const {
    ProbabilityRequest of_round = request_;
    budget_.share(parts, of_round);
    of_round.max_memory -= std::min(bytes_, mostTreeMemory(request_));
    if (!(answer_.reach > 0.0)) {
      // Steps and ends that are left out widen the interval, too.
      of_round.absolute_tolerance *= 1.0 - 2.0 * kShareOfFar;
      of_round.relative_tolerance *= 1.0 - 2.0 * kShareOfFar;
      return of_round;
    }
    // Steps that are too long may not tell it, however long they are asked.
    of_round.threshold.reset();
    of_round.relative_tolerance *= kShareOfCells;
    of_round.absolute_tolerance = std::max(kShareOfCells * request_.absolute_tolerance, expected_);
    if (request_.threshold) of_round.relative_tolerance = 0.0;
    if (is_first_) of_round.relative_tolerance = std::max(of_round.relative_tolerance, kCoarse);
    return of_round;
  }

  /// Ends a question that has decided the threshold, and makes its progress that of the motion.
  /// \param boundsOf  on P, of what is known of the question
  template <typename BoundsOf>
  void watch(ProbabilityRequest& of_round, const BoundsOf& boundsOf) const {
    if (!request_.on_progress && !request_.threshold) return;
    of_round.on_progress = [this, boundsOf](ProbabilityProgress progress) {
      progress.interval = agreed(known_, boundsOf(progress.interval));
      progress.seconds = budget_.seconds();
      if (request_.on_progress && !request_.on_progress(progress)) return false;
      return !isDecided(decisionOf(progress.interval, request_));
    };
  }

  double withFar(double upper) const { return std::min(1.0, sumAbove(upper, far_upper_)); }

  /// The best bounds of all rounds.
  void keep(const ProbabilityResult& answer, const Bounds& bounds) {
    budget_.spend(answer.statistics);
    known_ = agreed(known_, bounds);
    ProbabilityStatistics statistics = answer.statistics;
    addStatistics(answer_.result.statistics, statistics);
    answer_.result = answer;
    answer_.result.statistics = std::move(statistics);
  }

  std::optional<ProbabilityStatus> isEnough() const { return satisfied(known_, request_); }

  /// A limit that shorter steps do not move.
  static bool stops(ProbabilityStatus status) {
    return !isAnswered(status) && status != ProbabilityStatus::resolution_limit;
  }

  /// What is decided without the steps that are far need not be so with them.
  ProbabilityStatus ofAllSteps(ProbabilityStatus of_near) const {
    const bool is_undecided = asksForDecision(request_) && of_near == ProbabilityStatus::decided;
    return is_undecided ? ProbabilityStatus::resolution_limit : of_near;
  }

  /// What steps add to the interval falls between in proportion to their length and to its square.
  double shrunk() {
    const double width = known_.width();
    const double wanted = request_.toleranceAt(known_.upper);
    const double factor = std::clamp(0.7 * std::sqrt(wanted / width), kMostShrunk, kLeastShrunk);
    expected_ = kShareOfNext * factor * factor * width;
    is_first_ = false;
    return factor;
  }

  SweptAnswer finished(ProbabilityStatus status) {
    answer_.result.lower = known_.lower;
    answer_.result.upper = known_.upper;
    answer_.result.decision = decisionOf(known_, request_);
    answer_.result.method = ProbabilityMethod::interval;
    answer_.result.status = status;
    return std::move(answer_);
  }

  const SweptPath& path_;
  const ObstacleAmongBodies& scene_;
  const ObstacleState& state_;
  Ball around_obstacle_;
  double most_far_;
  const ProbabilityRequest& request_;
  Budget budget_;
  Bounds known_;
  std::vector<SweptBody> near_;      ///< a heap by reach
  std::vector<SweptBody> shortest_;  ///< as short as steps get
  std::size_t bytes_ = 0;            ///< of the trees of all steps
  std::size_t far_ = 0;
  double far_upper_ = 0.0;
  SweptAnswer answer_;
  double expected_ = 0.0;  ///< a tolerance that the next round can use
  bool is_first_ = true;   ///< round
};

}  // namespace

SweptAnswer sweptMotion(const SweptPath& path, const ObstacleAmongBodies& scene,
                        const ObstacleState& state, double most_far, const Bounds& known,
                        const ProbabilityRequest& request) {
  return SweptMotion(path, scene, state, most_far, known, request).run();
}

}  // namespace fcl_prob::detail
