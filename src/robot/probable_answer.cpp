// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/probable_answer.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/budget.h"
#include "base/known.h"
#include "base/random_words.h"
#include "base/rounded_sum.h"
#include "fcl_prob/combined_bounds.h"
#include "lines/line_bets.h"
#include "robot/body_bounds.h"

namespace fcl_prob::detail {
namespace {

/// Of the threshold: what bodies that are far may add up to, over all obstacles.
constexpr double kFarOfThreshold = 1e-3;

/// Of the threshold: what other bodies that samples are not drawn for may add up to.
constexpr double kUnlikelyOfThreshold = 0.01;

/// Of what the others leave open, obstacles that half-spaces bound so well need no lines.
constexpr double kHardlyOpen = 0.3;

/// One obstacle: what is certain, and what lines tell of it.
class ObstacleSampling {
 public:
  /// \param most_far  what bodies that balls show to be far may add up to
  ObstacleSampling(const ProbableScene& scene, const PreparedRobot& robot, double most_far);

  Bounds certified() const { return certified_; }
  Bounds probable() const { return probable_; }
  bool isDone() const { return scene_.bodies.empty(); }
  std::size_t columns() const { return lines_ ? lines_->columns() : 0; }
  std::size_t samples() const { return lines_ ? lines_->lines() : 0; }

  /// Half-spaces between bodies and obstacle; those that hardly matter need no samples.
  /// \param most_left_out  what they may add up to
  /// \param enough         a bound that is lower is of no more use
  void boundByHalfSpaces(double most_left_out, double enough);

  /// Makes what tells by lines. False where there are no lines.
  /// \param chance  of an error of theirs
  bool beginLines(const ProbabilityRequest& request, double chance);
  bool hasLines() const { return lines_ != nullptr; }

  /// P, about; before there are lines, half of its upper bound.
  double likely() const;

  /// As LineBets::improve().
  bool improveByLines(bool above, double target);

 private:
  Bounds within(const Bounds& of_near, const Bounds& known) const;

  ProbableScene scene_;
  const PreparedRobot& robot_;
  GaussianDisplacement displacement_;  ///< of the bodies
  double far_ = 0.0;
  std::shared_ptr<const PieceTree> tree_;
  PartitionObject bodies_{};
  PartitionObject obstacle_{};
  std::unique_ptr<LineBets> lines_;
  Bounds certified_;
  Bounds probable_;
};

GaussianDisplacement displacementOfBodies(const ProbableScene& scene) {
  return std::get<GaussianDisplacement>(scene.state.displacement).reversed();
}

ObstacleSampling::ObstacleSampling(const ProbableScene& scene, const PreparedRobot& robot,
                                   double most_far)
    : scene_(scene), robot_(robot), displacement_(displacementOfBodies(scene)) {
  far_ = leaveOutFar(robot.balls, scene.obstacle->around(), scene.state, most_far, scene_.bodies);
  certified_ = {0.0, scene_.bodies.empty() ? far_ : 1.0};
  probable_ = certified_;
}

void ObstacleSampling::boundByHalfSpaces(double most_left_out, double enough) {
  if (scene_.bodies.empty()) return;
  const BodyBounds bounds(robot_, scene_.bodies, *scene_.obstacle, scene_.state.pose,
                          displacement_);
  double left_out = 0.0;
  scene_.bodies = bounds.likelier(most_left_out, left_out);
  certified_.upper = std::min(certified_.upper, sumAbove(bounds.together(enough - far_), far_));
  probable_.upper = std::min(probable_.upper, certified_.upper);
  far_ = sumAbove(far_, left_out);
}

bool ObstacleSampling::beginLines(const ProbabilityRequest& request, double chance) {
  std::vector<const PieceTree*> trees;
  for (const PlacedBody& body : scene_.bodies) {
    const PreparedGeometry& geometry = *robot_.geometries[body.body];
    trees.push_back(&geometry.pieces());
    bodies_.parts.push_back({body.pose, geometry.solid(request.contact)});
  }
  tree_ = joinPieceTrees(trees);
  bodies_.tree = tree_.get();
  const PreparedObstacle& obstacle = *scene_.obstacle;
  obstacle_ = obstacle.group().placed(obstacle.poses(scene_.state.pose), request.contact);
  lines_ = LineBets::of(bodies_, obstacle_, displacement_, request, chance);
  if (!lines_) return false;
  certified_ = within(lines_->certified(), certified_);
  probable_ = within(lines_->probable(), probable_);
  return true;
}

double ObstacleSampling::likely() const {
  if (!lines_) return 0.5 * (probable_.lower + probable_.upper);
  return std::clamp(lines_->likely(), probable_.lower, probable_.upper);
}

bool ObstacleSampling::improveByLines(bool above, double target) {
  const bool goes_on = lines_->improve(above, above ? target : std::max(0.0, target - far_));
  certified_ = within(lines_->certified(), certified_);
  probable_ = within(lines_->probable(), probable_);
  return goes_on;
}

/// What is far is besides.
Bounds ObstacleSampling::within(const Bounds& of_near, const Bounds& known) const {
  return agreed(known, {of_near.lower, sumAbove(of_near.upper, far_)});
}

class AnyProbably {
 public:
  AnyProbably(const std::vector<ProbableScene>& scenes, const PreparedRobot& robot,
              double threshold, double chance, const ProbabilityRequest& request)
      : threshold_(threshold), chance_(chance), request_(request), budget_(request_) {
    const double far = kFarOfThreshold * threshold / static_cast<double>(scenes.size());
    for (const ProbableScene& scene : scenes) {
      obstacles_.push_back(std::make_unique<ObstacleSampling>(scene, robot, far));
    }
    // No obstacle decides by itself: beside it there are others, or bodies left out as far away.
    request_.threshold.reset();
  }

  ProbableResult run() {
    if (decide()) return finished(ProbabilityStatus::decided);
    const double share = threshold_ / static_cast<double>(obstacles_.size());
    for (const auto& obstacle : obstacles_) {
      obstacle->boundByHalfSpaces(kUnlikelyOfThreshold * share, share);
    }
    share_ = chance_ / static_cast<double>(obstacles_.size());
    // Undecided where there are no lines, or no more of them to be had.
    return finished(tryLines());
  }

 private:
  /// What is to be told next of an obstacle.
  struct LineTarget {
    ObstacleSampling* obstacle = nullptr;
    bool above = false;
    double value = 0.0;
  };

  /// Lines, as long as they pay. \return  why they ended
  ProbabilityStatus tryLines() {
    for (;;) {
      if (decide()) return ProbabilityStatus::decided;
      if (const auto stopped = budget_.look(result_.certified, 0.0)) return *stopped;
      const LineTarget next = nextTarget();
      if (next.obstacle == nullptr) return ProbabilityStatus::cell_limit;
      if (!next.obstacle->hasLines()) {
        if (!next.obstacle->beginLines(withNextSeed(), share_))
          return ProbabilityStatus::cell_limit;
      } else if (!next.obstacle->improveByLines(next.above, next.value)) {
        return ProbabilityStatus::cell_limit;
      }
    }
  }

  /// What is drawn for an obstacle may depend on what was drawn for others before, and must not be
  /// the same.
  ProbabilityRequest withNextSeed() {
    ProbabilityRequest request = request_;
    request.seed += ++seeds_ * kSeedsApart;
    return request;
  }

  /// The likeliest obstacle without lines, if they all together are open for too much of what
  /// there is to the threshold; else one with lines, and where its end of the interval should be:
  /// each is left a share of that, the more so, the more open it is. One after the other gets
  /// there, and what the ones before have left over is for those behind.
  LineTarget nextTarget() {
    double none = 1.0, hidden = 0.0;
    ObstacleSampling* without = nullptr;
    for (const auto& obstacle : obstacles_) {
      if (obstacle->hasLines()) {
        none *= 1.0 - obstacle->likely();
      } else if (!obstacle->isDone()) {
        hidden += obstacle->certified().width();
        if (!without || without->certified().upper < obstacle->certified().upper) {
          without = obstacle.get();
        }
      }
    }
    const bool above = 1.0 - none > threshold_;
    if (without && hidden > kHardlyOpen * std::fabs(1.0 - none - threshold_)) return {without};
    return nextOfLines(above);
  }

  LineTarget nextOfLines(bool above) const {
    std::vector<double> open, at;
    double all_open = 0.0;
    for (const auto& obstacle : obstacles_) {
      const bool counts = obstacle->hasLines();
      const double end = endOf(*obstacle, above);
      at.push_back(counts ? obstacle->likely() : end);
      const Bounds certified = obstacle->certified();
      const double most = above ? at.back() : certified.upper - at.back();
      all_open += open.emplace_back(counts ? std::sqrt(std::max(most, 0.0)) : 0.0);
    }
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (!(open[i] > 0.0)) continue;
      double others = 1.0;
      for (std::size_t j = 0; j < at.size(); ++j) others *= j == i ? 1.0 : 1.0 - at[j];
      const double left = 1.0 - (1.0 - threshold_) / others;
      const double target = at[i] + (left - at[i]) * std::min(1.0, open[i] / all_open);
      all_open -= open[i];
      at[i] = endOf(*obstacles_[i], above);
      const bool is_there = above ? at[i] >= target : at[i] <= target;
      if (!is_there) return {obstacles_[i].get(), above, target};
    }
    return {};
  }

  static double endOf(const ObstacleSampling& obstacle, bool above) {
    return above ? obstacle.probable().lower : obstacle.probable().upper;
  }

  bool decide() {
    std::vector<Bounds> certified, probable;
    for (const auto& obstacle : obstacles_) {
      certified.push_back(obstacle->certified());
      probable.push_back(obstacle->probable());
    }
    result_.certified = anyOfIndependent(certified);
    result_.probable = anyOfIndependent(probable);
    result_.decision = ProbableDecision::undecided;
    result_.chance_of_error = 0.0;
    if (result_.certified.upper < threshold_) {
      result_.decision = ProbableDecision::certainly_below;
    } else if (result_.certified.lower > threshold_) {
      result_.decision = ProbableDecision::certainly_above;
    } else if (result_.probable.upper < threshold_) {
      result_.decision = ProbableDecision::probably_below;
      result_.chance_of_error = chance_;
    } else if (result_.probable.lower > threshold_) {
      result_.decision = ProbableDecision::probably_above;
      result_.chance_of_error = chance_;
    }
    return result_.decision != ProbableDecision::undecided;
  }

  ProbableResult finished(ProbabilityStatus status) {
    result_.status = status;
    for (const auto& obstacle : obstacles_) {
      result_.cells += obstacle->columns();
      result_.samples += obstacle->samples();
    }
    return result_;
  }

  double threshold_;
  double chance_;
  ProbabilityRequest request_;
  std::uint64_t seeds_ = 0;
  double share_ = 0.0;  ///< of an obstacle in the chance
  Budget budget_;
  std::vector<std::unique_ptr<ObstacleSampling>> obstacles_;
  ProbableResult result_;
};

}  // namespace

bool canBeSampled(const PreparedObstacle& obstacle, const ObstacleState& state) {
  const auto* gaussian = std::get_if<GaussianDisplacement>(&state.displacement);
  const MemberGroup& group = obstacle.group();
  return gaussian && gaussian->rank() > 0 && !group.anyUnbounded() && !group.bounded().empty() &&
         !group.tree().isEmpty();
}

// What lines do not decide is proven.
ProbableResult probablyAny(const std::vector<ProbableScene>& scenes, const PreparedRobot& robot,
                           double threshold, double chance, const Proof& prove,
                           const ProbabilityRequest& request) {
  Budget budget(request);
  const ProbableResult soon = AnyProbably(scenes, robot, threshold, chance, request).run();
  ProbabilityStatistics spent;
  spent.cells = soon.cells;
  spent.samples = soon.samples;
  budget.spend(spent);
  if (soon.status != ProbabilityStatus::cell_limit || budget.exhausted()) return soon;
  ProbabilityRequest rest = request;
  budget.share(1, rest);
  ProbableResult proven = prove(rest);
  proven.cells += soon.cells;
  proven.samples += soon.samples;
  if (proven.decision == ProbableDecision::undecided) {
    const auto [lower, upper] = proven.certified;
    proven.probable = {std::clamp(soon.probable.lower, lower, upper),
                       std::clamp(soon.probable.upper, lower, upper)};
  }
  return proven;
}

}  // namespace fcl_prob::detail
