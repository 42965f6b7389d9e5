// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "base/budget.h"
#include "base/decision.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/monte_carlo.h"
#include "geometry/displaced_collider.h"
#include "sampling/importance_density.h"
#include "sampling/mixture_fit.h"
#include "sampling/sampling_run.h"
#include "sampling/whitened_obstacle.h"

namespace fcl_prob {
namespace {

using namespace detail;

constexpr std::uint64_t kPilots = 4;
constexpr double kPilotShare = 0.05;                // of the samples, each, ...
constexpr std::size_t kMostPilotSamples = 1 << 15;  // ... for more do not make a mixture better
constexpr double kCoverShareOfPilots = 0.4;
constexpr double kCoverShare = 0.2;
constexpr int kMostComponents = 8;

// Deviations behind the nearest contact: what collides farther out is less than 1e-8 of the rest.
constexpr double kBehindNearest = 6.0;

/// fcl::collide as a function of the whitened displacement.
class WhitenedCollider {
 public:
  WhitenedCollider(const DisplacedCollider& collider, const Whitening& whitening)
      : collider_(collider), whitening_(whitening) {}

  bool collides(const Eigen::Vector3d& y) const {
    return collider_.collides(whitening_.unapply(y));
  }

 private:
  const DisplacedCollider& collider_;
  const Whitening& whitening_;
};

/// Before anything has been hit: around the nearest point, short along the direction of approach,
/// as the tail of the normal density is there.
std::vector<MixtureComponent> firstGuess(const WhitenedObstacle& obstacle) {
  if (!obstacle.nearest) return {};
  const Eigen::Matrix3d precision =
      Eigen::Matrix3d::Identity() + *obstacle.nearest * obstacle.nearest->transpose();
  return {{1.0, *obstacle.nearest, precision.inverse()}};
}

/// Learns from pilot runs where the hits are; their samples do not count for the answer.
class DensityAdaptation {
 public:
  DensityAdaptation(const WhitenedCollider& collider, const WhitenedObstacle& obstacle,
                    const ProbabilityRequest& request, Budget& budget,
                    std::optional<ProbabilityStatus> interruption)
      : collider_(collider),
        obstacle_(obstacle),
        request_(request),
        budget_(budget),
        loop_(request.threads),
        samples_of_pilot_(
            std::min(kMostPilotSamples,
                     static_cast<std::size_t>(kPilotShare * static_cast<double>(request.samples)))),
        interruption_(interruption) {}

  ImportanceDensity adapt() {
    std::vector<MixtureComponent> mixture = firstGuess(obstacle_);
    for (std::uint64_t pilot = 1; pilot <= kPilots && !interruption_; ++pilot) {
      densities_.push_back(densityOf(kCoverShareOfPilots, mixture));
      draw({request_.seed, pilot});
      const auto fitted = fitMixture(weightedHits(), obstacle_.whitening.rank(), kMostComponents);
      if (!fitted.empty()) mixture = fitted;
    }
    return densityOf(kCoverShare, mixture);
  }

  std::size_t samplesUsed() const { return used_; }

  /// Whether a limit came before the last pilot: the density is what was learnt by then.
  std::optional<ProbabilityStatus> interruption() const { return interruption_; }

 private:
  ImportanceDensity densityOf(double cover_share,
                              const std::vector<MixtureComponent>& mixture) const {
    return {obstacle_.whitening.rank(), obstacle_.cover, cover_share, mixture};
  }

  void draw(RandomStream stream) {
    std::vector<Eigen::Vector3d> points(samples_of_pilot_);
    std::vector<unsigned char> collided(points.size());
    const std::size_t used_before = used_;
    const std::size_t drawn = loop_.run(
        0, points.size(),
        [&](std::size_t i) {
          points[i] = densities_.back().sample(stream, i);
          collided[i] = collider_.collides(points[i]);
        },
        [&](std::size_t done) {
          used_ = used_before + done;
          interruption_ = budget_.look({0.0, 1.0}, fraction());
          return !interruption_;
        });
    for (std::size_t i = 0; i < drawn; ++i) {
      if (collided[i]) hits_.push_back(points[i]);
    }
  }

  double fraction() const {
    return static_cast<double>(used_) / static_cast<double>(request_.samples);
  }

  /// Weighted as if every hit had been drawn from the mean of all densities so far, which keeps the
  /// poor first ones from dominating (adaptive multiple importance sampling, Cornuet et al. 2012).
  std::vector<WeightedPoint> weightedHits() const {
    std::vector<WeightedPoint> weighted;
    for (const Eigen::Vector3d& y : hits_) {
      double ratio = 0.0;
      for (const ImportanceDensity& density : densities_) ratio += density.ratio(y);
      weighted.push_back({y, 1.0 / ratio});
    }
    return weighted;
  }

  const WhitenedCollider& collider_;
  const WhitenedObstacle& obstacle_;
  const ProbabilityRequest& request_;
  Budget& budget_;
  SampleLoop loop_;
  std::size_t samples_of_pilot_;
  std::size_t used_ = 0;
  std::optional<ProbabilityStatus> interruption_;  ///< once a limit was met
  std::vector<ImportanceDensity> densities_;
  std::vector<Eigen::Vector3d> hits_;
};

class RareEventRun : public SamplingRun {
 public:
  RareEventRun(const WhitenedCollider& collider, const ImportanceDensity& density,
               const WhitenedObstacle& obstacle, const ProbabilityRequest& request,
               std::size_t samples)
      : SamplingRun(request, samples, 0.0),
        collider_(collider),
        density_(density),
        whitening_(obstacle.whitening),
        request_(request),
        points_(kSlots),
        weights_(kSlots),
        unit_(std::max(density.largestWeight(), std::numeric_limits<double>::min())),
        gradient_(whitening_.matrix().colwise().norm().transpose(),
                  unit_ * ((obstacle.nearest ? obstacle.nearest->norm() : 0.0) + kBehindNearest)) {}

  ProbabilityResult result(Budget& budget) {
    ProbabilityResult result = run(budget);
    const auto n = static_cast<double>(counted());
    const double mean = hits_.sum / n;
    // With half a hit added, so that it is not 0 where all samples agree: of the largest weight
    // without hits, else one like the others.
    const double second =
        hits_.hits > 0 ? hits_.sum_squares * (1.0 + 0.5 / static_cast<double>(hits_.hits)) : 0.5;
    result.estimate = unit_ * mean;
    result.standard_error = unit_ * std::sqrt(std::max(0.0, second / n - mean * mean) / n);
    result.statistics.hits = hits_.hits;
    result.statistics.effective_samples =
        hits_.sum_squares > 0.0 ? hits_.sum * hits_.sum / hits_.sum_squares : 0.0;
    if (request_.gradient) gradient_.report(whitening_.rank() == 3, counted(), result);
    return result;
  }

 private:
  void evaluate(std::size_t index, std::size_t slot) override {
    points_[slot] = density_.sample({request_.seed, 0}, index);
    weights_[slot] = collider_.collides(points_[slot]) ? 1.0 / density_.ratio(points_[slot]) : 0.0;
  }

  void count(std::size_t, std::size_t slot) override {
    if (weights_[slot] == 0.0) return;
    hits_.add(weights_[slot] / unit_);
    if (request_.gradient) gradient_.add(whitening_, points_[slot], weights_[slot]);
  }

  Bounds interval(double confidence) const override {
    const auto n = static_cast<double>(counted());
    const Bounds of_sum = gammaInterval(hits_, 1.0, confidence);
    return {unit_ * (of_sum.lower / n), std::min(1.0, unit_ * (of_sum.upper / n))};
  }

  const WhitenedCollider& collider_;
  const ImportanceDensity& density_;
  const Whitening& whitening_;
  const ProbabilityRequest& request_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<double> weights_;
  double unit_;        ///< the largest weight
  WeightedHits hits_;  ///< in that unit, so that their squares do not underflow
  GradientSum gradient_;
};

/// Nothing that the displacement can do collides.
ProbabilityResult certainlyFree(const ProbabilityRequest& request) {
  ProbabilityResult result;
  result.estimate = 0.0;
  result.standard_error = 0.0;
  result.confidence_interval = Bounds{0.0, 0.0};
  result.statistics.effective_samples = 0.0;
  result.status = ProbabilityStatus::exact;
  result.decision = decisionOf({0.0, 0.0}, request);
  result.plan.push_back("no displacement with a mass in double precision can collide");
  return result;
}

ProbabilityResult sampleRareEvent(const DisplacedCollider& displaced,
                                  const WhitenedObstacle& obstacle,
                                  const ProbabilityRequest& request, Budget& budget,
                                  std::optional<ProbabilityStatus> interruption) {
  const WhitenedCollider collider(displaced, obstacle.whitening);
  DensityAdaptation adaptation(collider, obstacle, request, budget, interruption);
  const ImportanceDensity density = adaptation.adapt();
  RareEventRun run(collider, density, obstacle, request,
                   request.samples - adaptation.samplesUsed());
  if (adaptation.interruption()) run.interrupt(*adaptation.interruption());
  ProbabilityResult result = run.result(budget);
  result.statistics.samples += adaptation.samplesUsed();
  const bool shell = obstacle.cover.shell_radius > 0.0;
  result.plan.push_back(
      "importance sampling from a mixture fitted to " + std::to_string(adaptation.samplesUsed()) +
      " pilot samples, and from " +
      (shell ? "everything beyond the nearest contact"
             : std::to_string(obstacle.cover.boxes.size()) + " boxes around the obstacle") +
      "; nothing is certified");
  return result;
}

}  // namespace

ProbabilityResult rareEventProbability(const fcl::CollisionGeometryd& a,
                                       const fcl::Transform3d& pose_a,
                                       const fcl::CollisionGeometryd& b,
                                       const fcl::Transform3d& pose_b,
                                       const GaussianDisplacement& displacement,
                                       const ProbabilityRequest& request) {
  validateRequest(request);
  Budget budget(request);
  const DisplacedCollider displaced(a, pose_a, b, pose_b, request.contact);
  if (displacement.rank() == 0) {
    throw InvalidRequest("rare-event sampling needs a displacement that is random");
  }
  std::optional<ProbabilityStatus> interruption;
  const auto interrupted = [&] {
    if (!interruption) interruption = budget.look();
    return interruption.has_value();
  };
  const WhitenedObstacle obstacle =
      whitenedObstacle(a, pose_a, b, pose_b, displacement, request.contact,
                       displaced.collides(displacement.mean()), interrupted);
  const double obstacle_seconds = budget.seconds();
  ProbabilityResult result =
      obstacle.cover.empty() ? certainlyFree(request)
                             : sampleRareEvent(displaced, obstacle, request, budget, interruption);
  result.method = ProbabilityMethod::rare_event;
  result.statistics.seconds.emplace_back("nearest contact and cover", obstacle_seconds);
  result.statistics.seconds.emplace_back("sampling", budget.seconds() - obstacle_seconds);
  result.plan.insert(result.plan.begin(), displaced.plan().begin(), displaced.plan().end());
  return result;
}

}  // namespace fcl_prob
