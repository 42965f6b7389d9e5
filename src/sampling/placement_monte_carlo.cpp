// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "sampling/placement_monte_carlo.h"

#include <string>

#include "base/random_words.h"
#include "base/symmetric_axes.h"
#include "fcl_prob/monte_carlo.h"
#include "geometry/validation.h"
#include "sampling/counting_run.h"

namespace fcl_prob {
namespace detail {
namespace {

class PlacementRun : public CountingRun {
 public:
  PlacementRun(const GeometryList& a, const GeometryList& b, const PlacementSampler& sampler,
               const ProbabilityRequest& request)
      : CountingRun(request), sampler_(sampler), collider_(a, b, request.contact) {}

  const std::vector<std::string>& plan() const { return collider_.plan(); }

 private:
  bool collides(std::size_t index) const override { return collider_.collides(sampler_(index)); }

  const PlacementSampler& sampler_;
  PlacementCollider collider_;
};

}  // namespace

ProbabilityResult placementMonteCarlo(const GeometryList& a, const GeometryList& b,
                                      const PlacementSampler& sampler,
                                      const ProbabilityRequest& request) {
  validateRequest(request);
  Budget budget(request);
  PlacementRun run(a, b, sampler, request);
  ProbabilityResult result = run.result(budget);
  result.plan = run.plan();
  result.plan.push_back("Monte Carlo: fcl::collide at random poses; the interval has confidence " +
                        std::to_string(request.confidence) + ", nothing is certified");
  if (request.gradient) result.plan.push_back("no gradient: the estimate has one");
  return result;
}

}  // namespace detail

namespace {

// L with L Lᵀ = covariance, of any rank; metres and radians are brought to one scale first.
PoseError::Matrix6 squareRootOf(const PoseError::Matrix6& covariance) {
  const PoseError::Vector6 scales = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  PoseError::Matrix6 correlation = PoseError::Matrix6::Identity();
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      if (i != j && scales[i] > 0.0 && scales[j] > 0.0) {
        correlation(i, j) = covariance(i, j) / scales[i] / scales[j];
      }
    }
  }
  const auto solver = detail::symmetricAxes(correlation);
  return scales.asDiagonal() * solver.eigenvectors() *
         solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

}  // namespace

ProbabilityResult poseMonteCarloProbability(const fcl::CollisionGeometryd& a,
                                            const fcl::Transform3d& pose_a,
                                            const fcl::CollisionGeometryd& b,
                                            const fcl::Transform3d& pose_b, const PoseError& error,
                                            const ProbabilityRequest& request) {
  validateRequest(request);
  detail::validatePose(pose_a, "object A");
  detail::validatePose(pose_b, "object B");
  const PoseError::Matrix6 root = squareRootOf(error.covariance());
  const auto sampler = [&](std::size_t index) {
    PoseError::Vector6 normals;
    normals << detail::standardNormalFrom(detail::randomWords({request.seed}, index, 0)),
        detail::standardNormalFrom(detail::randomWords({request.seed}, index, 1));
    const PoseError::Vector6 sample = error.mean() + root * normals;
    return detail::SampledPlacement{{displacedPose(pose_a, error.convention(), sample)}, {pose_b}};
  };
  const auto unowned = [](const fcl::CollisionGeometryd& geometry) {
    return std::shared_ptr<const fcl::CollisionGeometryd>(std::shared_ptr<const void>(), &geometry);
  };
  return detail::placementMonteCarlo({unowned(a)}, {unowned(b)}, sampler, request);
}

}  // namespace fcl_prob
