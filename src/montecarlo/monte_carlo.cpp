// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/monte_carlo.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "montecarlo/confidence.h"
#include "montecarlo/displaced_collider.h"
#include "montecarlo/random_samples.h"
#include "montecarlo/sample_loop.h"

namespace fcl_prob {
namespace {

using detail::LookSchedule;

/// Hits so far, and the sums over them from which the gradient comes. Filled in the order of the
/// samples, so that the sums do not depend on how they were divided among threads.
struct Tally {
  std::size_t samples = 0;
  std::size_t hits = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d sum_outer = Eigen::Matrix3d::Zero();

  Bounds interval(double confidence) const {
    return clopperPearsonInterval(hits, samples, confidence);
  }
};

class MonteCarloRun {
 public:
  MonteCarloRun(const detail::DisplacedCollider& collider, const GaussianDisplacement& displacement,
                const ProbabilityRequest& request)
      : collider_(collider),
        displacement_(displacement),
        request_(request),
        scaled_axes_(displacement.axes() * displacement.standardDeviations().asDiagonal()),
        looks_(request.samples, request.confidence),
        loop_(request.threads),
        collided_(detail::SampleLoop::kLargestChunk) {}

  ProbabilityResult run() {
    ProbabilityStatus status = ProbabilityStatus::sampled;
    double confidence = looks_.finalConfidence();
    while (tally_.samples < request_.samples) {
      const std::size_t look = looks_.next(tally_.samples);
      loop_.run(
          tally_.samples, look, [this](std::size_t i) { collided_[slot(i)] = collides(i); },
          [this](std::size_t done) { return countUpTo(done); });
      if (interruption_) {
        status = *interruption_;
        break;
      }
      const double confidence_here = looks_.confidenceAt(look);
      if (const auto reason = reasonToStop(tally_.interval(confidence_here))) {
        status = *reason;
        confidence = confidence_here;
        break;
      }
    }
    return result(status, confidence);
  }

 private:
  Eigen::Vector3d normals(std::size_t index) const {
    return detail::standardNormalFrom(detail::randomWords({request_.seed}, index));
  }

  bool collides(std::size_t index) const {
    return collider_.collides(displacement_.mean() + scaled_axes_ * normals(index));
  }

  static std::size_t slot(std::size_t index) { return index % detail::SampleLoop::kLargestChunk; }

  bool countUpTo(std::size_t done) {
    for (; tally_.samples < done; ++tally_.samples) {
      if (!collided_[slot(tally_.samples)]) continue;
      ++tally_.hits;
      if (!request_.gradient) continue;
      const Eigen::Vector3d y = normals(tally_.samples);
      tally_.sum += y;
      tally_.sum_outer += y * y.transpose();
    }
    if (done == request_.samples) return true;
    if (request_.time_limit && watch_.seconds() >= *request_.time_limit) {
      interruption_ = ProbabilityStatus::time_limit;
    } else if (request_.on_progress && !request_.on_progress(progress())) {
      interruption_ = ProbabilityStatus::cancelled;
    }
    return !interruption_;
  }

  ProbabilityProgress progress() const {
    ProbabilityProgress progress;
    progress.interval = tally_.interval(looks_.finalConfidence());
    progress.seconds = watch_.seconds();
    progress.fraction = static_cast<double>(tally_.samples) / static_cast<double>(request_.samples);
    if (request_.time_limit) {
      progress.fraction = std::max(progress.fraction, progress.seconds / *request_.time_limit);
    }
    return progress;
  }

  std::optional<ProbabilityStatus> reasonToStop(const Bounds& interval) const {
    if (decisionOf(interval) == Decision::below || decisionOf(interval) == Decision::above) {
      return ProbabilityStatus::decided;
    }
    const double tolerance =
        std::max(request_.absolute_tolerance, request_.relative_tolerance * interval.upper);
    if (0.5 * interval.width() <= tolerance) {
      return ProbabilityStatus::converged;
    }
    return std::nullopt;
  }

  Decision decisionOf(const Bounds& interval) const {
    if (!request_.threshold) return Decision::none;
    if (interval.upper < *request_.threshold) return Decision::below;
    if (interval.lower > *request_.threshold) return Decision::above;
    return Decision::undecided;
  }

  ProbabilityResult result(ProbabilityStatus status, double confidence) const {
    ProbabilityResult result;
    result.method = ProbabilityMethod::monte_carlo;
    result.status = status;
    const auto n = static_cast<double>(tally_.samples);
    const auto hits = static_cast<double>(tally_.hits);
    const double smoothed = (hits + 0.5) / (n + 1.0);
    result.estimate = hits / n;
    result.standard_error = std::sqrt(smoothed * (1.0 - smoothed) / n);
    result.confidence_interval = tally_.interval(confidence);
    result.decision = decisionOf(*result.confidence_interval);
    result.statistics.samples = tally_.samples;
    result.statistics.hits = tally_.hits;
    result.statistics.seconds.emplace_back("sampling", watch_.seconds());
    if (request_.gradient) addGradient(result);
    return result;
  }

  // ∂P/∂mean = Σ^{-1/2} E[y 1_V(y)].
  void addGradient(ProbabilityResult& result) const {
    if (displacement_.rank() < 3) {
      result.plan.push_back("no gradient: P need not be differentiable where A does not move");
      return;
    }
    const auto n = static_cast<double>(tally_.samples);
    const Eigen::Vector3d mean = tally_.sum / n;
    const Eigen::Matrix3d covariance = tally_.sum_outer / n - mean * mean.transpose();
    const Eigen::Matrix3d unwhiten =
        displacement_.axes() * displacement_.standardDeviations().cwiseInverse().asDiagonal();
    result.gradient = unwhiten * mean;
    const Eigen::Vector3d variance = (unwhiten * covariance * unwhiten.transpose()).diagonal();
    result.gradient_standard_error = (variance.cwiseMax(0.0) / n).cwiseSqrt();
  }

  const detail::DisplacedCollider& collider_;
  const GaussianDisplacement& displacement_;
  const ProbabilityRequest& request_;
  Eigen::Matrix3d scaled_axes_;
  LookSchedule looks_;
  detail::SampleLoop loop_;
  detail::Stopwatch watch_;
  std::vector<unsigned char> collided_;  // of the samples of the running chunk
  Tally tally_;
  std::optional<ProbabilityStatus> interruption_;
};

}  // namespace

ProbabilityResult monteCarloProbability(const fcl::CollisionGeometryd& a,
                                        const fcl::Transform3d& pose_a,
                                        const fcl::CollisionGeometryd& b,
                                        const fcl::Transform3d& pose_b,
                                        const GaussianDisplacement& displacement,
                                        const ProbabilityRequest& request) {
  validateRequest(request);
  const detail::DisplacedCollider collider(a, pose_a, b, pose_b, request.contact);
  ProbabilityResult result = MonteCarloRun(collider, displacement, request).run();
  result.plan.insert(result.plan.begin(), collider.plan().begin(), collider.plan().end());
  result.plan.push_back("Monte Carlo: displaced fcl::collide; the interval has confidence " +
                        std::to_string(request.confidence) + ", nothing is certified");
  return result;
}

}  // namespace fcl_prob
