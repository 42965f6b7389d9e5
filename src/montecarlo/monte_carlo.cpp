// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/monte_carlo.h"

#include <cmath>
#include <vector>

#include "montecarlo/displaced_collider.h"
#include "montecarlo/random_samples.h"
#include "montecarlo/sampling_run.h"

namespace fcl_prob {
namespace {

class MonteCarloRun : public detail::SamplingRun {
 public:
  MonteCarloRun(const detail::DisplacedCollider& collider, const GaussianDisplacement& displacement,
                const ProbabilityRequest& request)
      : SamplingRun(request, request.samples, request.absolute_tolerance),
        collider_(collider),
        whitening_(displacement),
        request_(request),
        collided_(kSlots) {}

  ProbabilityResult result() {
    const detail::Stopwatch watch;
    ProbabilityResult result = run(watch);
    result.method = ProbabilityMethod::monte_carlo;
    const auto n = static_cast<double>(counted());
    const auto hits = static_cast<double>(hits_);
    const double smoothed = (hits + 0.5) / (n + 1.0);
    result.estimate = hits / n;
    result.standard_error = std::sqrt(smoothed * (1.0 - smoothed) / n);
    result.statistics.hits = hits_;
    result.statistics.seconds.emplace_back("sampling", watch.seconds());
    if (request_.gradient) gradient_.report(whitening_, counted(), result);
    return result;
  }

 private:
  Eigen::Vector3d normals(std::size_t index) const {
    Eigen::Vector3d y = detail::standardNormalFrom(detail::randomWords({request_.seed}, index));
    for (int k = whitening_.rank(); k < 3; ++k) y[k] = 0.0;
    return y;
  }

  void evaluate(std::size_t index, std::size_t slot) override {
    collided_[slot] = collider_.collides(whitening_.unapply(normals(index)));
  }

  void count(std::size_t index, std::size_t slot) override {
    if (!collided_[slot]) return;
    ++hits_;
    if (request_.gradient) gradient_.add(normals(index), 1.0);
  }

  Bounds interval(double confidence) const override {
    return clopperPearsonInterval(hits_, counted(), confidence);
  }

  const detail::DisplacedCollider& collider_;
  Whitening whitening_;
  const ProbabilityRequest& request_;
  std::vector<unsigned char> collided_;
  std::size_t hits_ = 0;
  detail::GradientSum gradient_;
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
  ProbabilityResult result = MonteCarloRun(collider, displacement, request).result();
  result.plan.insert(result.plan.begin(), collider.plan().begin(), collider.plan().end());
  result.plan.push_back("Monte Carlo: displaced fcl::collide; the interval has confidence " +
                        std::to_string(request.confidence) + ", nothing is certified");
  return result;
}

}  // namespace fcl_prob
