// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/monte_carlo.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/random_words.h"
#include "fcl_prob/mixture.h"
#include "geometry/displaced_collider.h"
#include "sampling/counting_run.h"

namespace fcl_prob {
namespace {

/// Of which a sample draws one. A single one takes nothing from the random numbers.
class SampledDisplacements {
 public:
  explicit SampledDisplacements(const GaussianDisplacement& displacement) {
    whitenings_.emplace_back(displacement);
  }
  explicit SampledDisplacements(const GaussianMixture& mixture) {
    double cumulated = 0.0;
    for (const GaussianMixture::Component& component : mixture.components()) {
      if (!(component.weight > 0.0)) continue;
      whitenings_.emplace_back(component.displacement);
      cumulated += component.weight;
      cumulated_.push_back(cumulated);
    }
  }

  const Whitening& chosen(detail::RandomStream stream, std::size_t index) const {
    if (whitenings_.size() == 1) return whitenings_[0];
    const double u = cumulated_.back() * detail::uniformFrom(randomWords(stream, index, 1)[0]);
    const auto at = std::upper_bound(cumulated_.begin(), cumulated_.end() - 1, u);
    return whitenings_[static_cast<std::size_t>(at - cumulated_.begin())];
  }

  /// The largest lengths of the columns of W.
  Eigen::Vector3d speeds() const {
    Eigen::Vector3d speeds = Eigen::Vector3d::Zero();
    for (const Whitening& whitening : whitenings_) {
      const Eigen::Vector3d of_one = whitening.matrix().colwise().norm().transpose();
      speeds = speeds.cwiseMax(of_one);
    }
    return speeds;
  }

  bool haveFullRank() const {
    return std::all_of(whitenings_.begin(), whitenings_.end(),
                       [](const Whitening& whitening) { return whitening.rank() == 3; });
  }

 private:
  std::vector<Whitening> whitenings_;
  std::vector<double> cumulated_;  ///< weights up to each, of several
};

// Deviations, of a coordinate of a sample: what is beyond has 2e-10 of its mean absolute value.
constexpr double kFarthest = 6.0;

class MonteCarloRun : public detail::CountingRun {
 public:
  MonteCarloRun(const detail::DisplacedCollider& collider, SampledDisplacements displacements,
                const ProbabilityRequest& request)
      : CountingRun(request),
        collider_(collider),
        displacements_(std::move(displacements)),
        request_(request),
        gradient_(displacements_.speeds(), kFarthest) {}

  ProbabilityResult resultWithGradient(detail::Budget& budget) {
    ProbabilityResult answer = result(budget);
    if (request_.gradient) gradient_.report(displacements_.haveFullRank(), counted(), answer);
    return answer;
  }

 private:
  const Whitening& whiteningOf(std::size_t index) const {
    return displacements_.chosen({request_.seed}, index);
  }

  Eigen::Vector3d normals(std::size_t index, int rank) const {
    Eigen::Vector3d y = detail::standardNormalFrom(detail::randomWords({request_.seed}, index));
    for (int k = rank; k < 3; ++k) y[k] = 0.0;
    return y;
  }

  bool collides(std::size_t index) const override {
    const Whitening& whitening = whiteningOf(index);
    return collider_.collides(whitening.unapply(normals(index, whitening.rank())));
  }

  void countHit(std::size_t index) override {
    if (!request_.gradient) return;
    const Whitening& whitening = whiteningOf(index);
    gradient_.add(whitening, normals(index, whitening.rank()), 1.0);
  }

  const detail::DisplacedCollider& collider_;
  SampledDisplacements displacements_;
  const ProbabilityRequest& request_;
  detail::GradientSum gradient_;
};

template <typename Displacement>
ProbabilityResult sampled(const fcl::CollisionGeometryd& a, const fcl::Transform3d& pose_a,
                          const fcl::CollisionGeometryd& b, const fcl::Transform3d& pose_b,
                          const Displacement& displacement, const ProbabilityRequest& request) {
  validateRequest(request);
  detail::Budget budget(request);
  const detail::DisplacedCollider collider(a, pose_a, b, pose_b, request.contact);
  ProbabilityResult result = MonteCarloRun(collider, SampledDisplacements(displacement), request)
                                 .resultWithGradient(budget);
  result.plan.insert(result.plan.begin(), collider.plan().begin(), collider.plan().end());
  result.plan.push_back("Monte Carlo: displaced fcl::collide; the interval has confidence " +
                        std::to_string(request.confidence) + ", nothing is certified");
  return result;
}

}  // namespace

ProbabilityResult monteCarloProbability(const fcl::CollisionGeometryd& a,
                                        const fcl::Transform3d& pose_a,
                                        const fcl::CollisionGeometryd& b,
                                        const fcl::Transform3d& pose_b,
                                        const GaussianDisplacement& displacement,
                                        const ProbabilityRequest& request) {
  return sampled(a, pose_a, b, pose_b, displacement, request);
}

ProbabilityResult monteCarloProbability(const fcl::CollisionGeometryd& a,
                                        const fcl::Transform3d& pose_a,
                                        const fcl::CollisionGeometryd& b,
                                        const fcl::Transform3d& pose_b,
                                        const GaussianMixture& displacement,
                                        const ProbabilityRequest& request) {
  return sampled(a, pose_a, b, pose_b, displacement, request);
}

}  // namespace fcl_prob
