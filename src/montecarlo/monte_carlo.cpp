// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/monte_carlo.h"

#include "montecarlo/counting_run.h"
#include "montecarlo/displaced_collider.h"
#include "montecarlo/random_samples.h"

namespace fcl_prob {
namespace {

class MonteCarloRun : public detail::CountingRun {
 public:
  MonteCarloRun(const detail::DisplacedCollider& collider, const GaussianDisplacement& displacement,
                const ProbabilityRequest& request)
      : CountingRun(request), collider_(collider), whitening_(displacement), request_(request) {}

  ProbabilityResult resultWithGradient() {
    ProbabilityResult answer = result();
    if (request_.gradient) gradient_.report(whitening_, counted(), answer);
    return answer;
  }

 private:
  Eigen::Vector3d normals(std::size_t index) const {
    Eigen::Vector3d y = detail::standardNormalFrom(detail::randomWords({request_.seed}, index));
    for (int k = whitening_.rank(); k < 3; ++k) y[k] = 0.0;
    return y;
  }

  bool collides(std::size_t index) const override {
    return collider_.collides(whitening_.unapply(normals(index)));
  }

  void countHit(std::size_t index) override {
    if (request_.gradient) gradient_.add(normals(index), 1.0);
  }

  const detail::DisplacedCollider& collider_;
  Whitening whitening_;
  const ProbabilityRequest& request_;
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
  ProbabilityResult result = MonteCarloRun(collider, displacement, request).resultWithGradient();
  result.plan.insert(result.plan.begin(), collider.plan().begin(), collider.plan().end());
  result.plan.push_back("Monte Carlo: displaced fcl::collide; the interval has confidence " +
                        std::to_string(request.confidence) + ", nothing is certified");
  return result;
}

}  // namespace fcl_prob
