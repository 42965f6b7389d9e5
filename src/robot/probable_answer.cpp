// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/probable_answer.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "fcl_prob/combined_bounds.h"
#include "partition/probable_partition.h"
#include "query/call_budget.h"
#include "robot/body_bounds.h"
#include "robot/sum_above.h"

namespace fcl_prob::detail {
namespace {

/// Of the threshold: what bodies that are far may add up to, over all obstacles.
constexpr double kFarOfThreshold = 1e-3;

/// Of the threshold: what other bodies that samples are not drawn for may add up to.
constexpr double kUnlikelyOfThreshold = 0.01;

/// A probable decision that needs more cells is tried to be proven, with no more cells than those.
constexpr std::size_t kCellsBeforeProof = 64;
constexpr std::size_t kCellsOfProof = 4'000;

/// Bodies against one obstacle, as far as they have been looked at.
class ObstacleSampling {
 public:
  ObstacleSampling(const ProbableScene& scene, const PreparedGeometries& geometries,
                   const std::vector<Ball>& balls, double most_far)
      : scene_(scene), geometries_(geometries), displacement_(gaussian(scene).reversed()) {
    far_ = leaveOutFar(balls, *scene.around, scene.state, most_far, scene_.bodies);
    certified_ = {0.0, scene_.bodies.empty() ? far_ : 1.0};
    probable_ = certified_;
  }

  Bounds certified() const { return certified_; }
  Bounds probable() const { return probable_; }
  bool isDone() const { return done_ || scene_.bodies.empty(); }
  std::size_t cells() const { return partition_ ? partition_->statistics().cells : 0; }
  std::size_t samples() const { return partition_ ? partition_->statistics().samples : 0; }

  /// Half-spaces between bodies and obstacle; those that hardly matter need no samples.
  /// \param most_left_out  what they may add up to
  void boundByHalfSpaces(double most_left_out) {
    if (scene_.bodies.empty()) return;
    const BodyBounds bounds(geometries_, scene_.bodies, *scene_.obstacle, scene_.state.pose,
                            displacement_);
    double left_out = 0.0;
    scene_.bodies = bounds.likelier(most_left_out, left_out);
    certified_.upper = std::min(certified_.upper, sumAbove(bounds.sum(), far_));
    probable_.upper = std::min(probable_.upper, certified_.upper);
    far_ = sumAbove(far_, left_out);
  }

  /// \return  why it stopped, if that is a limit
  std::optional<ProbabilityStatus> improve(const ProbabilityRequest& request, double chance,
                                           const std::function<bool()>& enough) {
    if (!partition_) begin(request, chance);
    const auto stopped = partition_->improve([&] {
      certified_ = within(partition_->certified(), certified_);
      probable_ = within(partition_->probable(), probable_);
      return enough();
    });
    done_ = stopped.has_value();
    return stopped == ProbabilityStatus::exact ? std::nullopt : stopped;
  }

 private:
  static const GaussianDisplacement& gaussian(const ProbableScene& scene) {
    return std::get<GaussianDisplacement>(scene.state.displacement);
  }

  void begin(const ProbabilityRequest& request, double chance) {
    std::vector<const PieceTree*> trees;
    for (const PlacedBody& body : scene_.bodies) {
      const PreparedGeometry& geometry = *geometries_[body.body];
      trees.push_back(&geometry.pieces());
      bodies_.parts.push_back({body.pose, geometry.solid(request.contact)});
    }
    tree_ = joinPieceTrees(trees);
    bodies_.tree = tree_.get();
    const PreparedGeometry& obstacle = *scene_.obstacle;
    obstacle_ = {&obstacle.pieces(), {{scene_.state.pose, obstacle.solid(request.contact)}}};
    partition_ =
        std::make_unique<ProbablePartition>(bodies_, obstacle_, displacement_, request, chance);
  }

  /// What is far is besides.
  Bounds within(const Bounds& of_near, const Bounds& known) const {
    const double upper = std::min(known.upper, sumAbove(of_near.upper, far_));
    return {std::min(upper, std::max(known.lower, of_near.lower)), upper};
  }

  ProbableScene scene_;
  const PreparedGeometries& geometries_;
  GaussianDisplacement displacement_;  ///< of the bodies
  double far_ = 0.0;
  std::shared_ptr<const PieceTree> tree_;
  PartitionObject bodies_{};
  PartitionObject obstacle_{};
  std::unique_ptr<ProbablePartition> partition_;
  bool done_ = false;
  Bounds certified_;
  Bounds probable_;
};

class AnyProbably {
 public:
  AnyProbably(const std::vector<ProbableScene>& scenes, const PreparedGeometries& geometries,
              const std::vector<Ball>& balls, double threshold, double chance,
              const ProbabilityRequest& request)
      : threshold_(threshold), chance_(chance), request_(request), budget_(request_) {
    const double far = kFarOfThreshold * threshold / static_cast<double>(scenes.size());
    for (const ProbableScene& scene : scenes) {
      obstacles_.push_back(std::make_unique<ObstacleSampling>(scene, geometries, balls, far));
    }
    // No obstacle decides by itself: beside it there are others, or bodies left out as far away.
    request_.threshold.reset();
  }

  ProbableResult run() {
    if (decide()) return finished(ProbabilityStatus::decided);
    const double unlikely =
        kUnlikelyOfThreshold * threshold_ / static_cast<double>(obstacles_.size());
    for (const auto& obstacle : obstacles_) obstacle->boundByHalfSpaces(unlikely);
    const double share = chance_ / static_cast<double>(obstacles_.size());
    while (!decide()) {
      ObstacleSampling* next = widest();
      if (next == nullptr) return finished(stopped_.value_or(ProbabilityStatus::exact));
      const auto limit = next->improve(request_, share, [this] { return decide(); });
      if (limit && !decide()) {
        stopped_ = limit;
        if (*limit == ProbabilityStatus::cancelled) return finished(*limit);
      }
      if (const auto out = budget_.exhausted(); out && !decide()) return finished(*out);
      if (cells() >= request_.max_cells && !decide()) {
        return finished(ProbabilityStatus::cell_limit);
      }
    }
    return finished(ProbabilityStatus::decided);
  }

 private:
  /// The obstacle that leaves most open and is not done.
  ObstacleSampling* widest() {
    ObstacleSampling* found = nullptr;
    for (const auto& obstacle : obstacles_) {
      if (obstacle->isDone()) continue;
      if (!found || obstacle->probable().width() > found->probable().width()) {
        found = obstacle.get();
      }
    }
    return found;
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

  std::size_t cells() const {
    std::size_t sum = 0;
    for (const auto& obstacle : obstacles_) sum += obstacle->cells();
    return sum;
  }

  ProbableResult finished(ProbabilityStatus status) {
    result_.status = status;
    result_.cells = cells();
    for (const auto& obstacle : obstacles_) result_.samples += obstacle->samples();
    return result_;
  }

  double threshold_;
  double chance_;
  ProbabilityRequest request_;
  CallBudget budget_;
  std::vector<std::unique_ptr<ObstacleSampling>> obstacles_;
  std::optional<ProbabilityStatus> stopped_;
  ProbableResult result_;
};

}  // namespace

bool canBeSampled(const PreparedGeometry& obstacle, const ObstacleState& state) {
  const auto* gaussian = std::get_if<GaussianDisplacement>(&state.displacement);
  return gaussian && gaussian->rank() > 0 && obstacle.hasPieces() && !obstacle.pieces().isEmpty();
}

// Where P is close to the threshold a proof takes less than samples do: it is tried before more of
// them are drawn. Those that have been drawn are drawn again then, the same ones, so that the
// chance of being wrong is that of the last run alone.
ProbableResult probablyAny(const std::vector<ProbableScene>& scenes,
                           const PreparedGeometries& geometries, const std::vector<Ball>& balls,
                           double threshold, double chance, const Proof& prove,
                           const ProbabilityRequest& request) {
  CallBudget budget(request);
  ProbabilityStatistics spent;
  const auto counted = [&](ProbableResult result) {
    ProbabilityStatistics of_one;
    of_one.cells = result.cells;
    of_one.samples = result.samples;
    budget.spend(of_one);
    result.cells = spent.cells += of_one.cells;
    result.samples = spent.samples += of_one.samples;
    return result;
  };
  const auto within = [&](std::size_t most_cells) {
    ProbabilityRequest part = request;
    budget.share(1, part);
    part.max_cells = std::min(part.max_cells, most_cells);
    return part;
  };
  const auto sampled = [&](std::size_t most_cells) {
    return counted(
        AnyProbably(scenes, geometries, balls, threshold, chance, within(most_cells)).run());
  };
  const ProbableResult soon = sampled(kCellsBeforeProof);
  if (soon.status != ProbabilityStatus::cell_limit || budget.exhausted()) return soon;
  ProbableResult proven = counted(prove(within(kCellsOfProof)));
  if (proven.decision != ProbableDecision::undecided) return proven;
  if (proven.status == ProbabilityStatus::cancelled || budget.exhausted()) {
    const auto [lower, upper] = proven.certified;
    proven.probable = {std::clamp(soon.probable.lower, lower, upper),
                       std::clamp(soon.probable.upper, lower, upper)};
    return proven;
  }
  return sampled(request.max_cells);
}

}  // namespace fcl_prob::detail
