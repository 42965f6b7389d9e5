// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/collision_probability.h"

#include "fcl_prob/exceptions.h"
#include "fcl_prob/monte_carlo.h"
#include "geometry/validation.h"
#include "query/query_plan.h"
#include "query/single_collide.h"

namespace fcl_prob {

struct PreparedQuery::Implementation {
  std::shared_ptr<const fcl::CollisionGeometryd> a;
  std::shared_ptr<const fcl::CollisionGeometryd> b;

  ProbabilityResult answer(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                           const GaussianDisplacement& displacement,
                           const ProbabilityRequest& request) const {
    const detail::QueryPlan plan = detail::planQuery(*a, *b, displacement, request);
    ProbabilityResult result = follow(plan, pose_a, pose_b, displacement, request);
    result.plan.insert(result.plan.begin(), plan.notes.begin(), plan.notes.end());
    return result;
  }

 private:
  ProbabilityResult follow(const detail::QueryPlan& plan, const fcl::Transform3d& pose_a,
                           const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                           const ProbabilityRequest& request) const {
    using Route = detail::QueryPlan::Route;
    switch (plan.route) {
      case Route::single_collide:
        return detail::singleCollide(*a, pose_a, *b, pose_b, displacement.mean(), request);
      case Route::monte_carlo:
        return monteCarloProbability(*a, pose_a, *b, pose_b, displacement, request);
    }
    throw InvalidRequest("no such route");
  }
};

PreparedQuery::PreparedQuery(std::shared_ptr<const fcl::CollisionGeometryd> a,
                             std::shared_ptr<const fcl::CollisionGeometryd> b) {
  detail::validateGeometry(a.get(), "object A");
  detail::validateGeometry(b.get(), "object B");
  implementation_ = std::make_unique<Implementation>(Implementation{std::move(a), std::move(b)});
}

PreparedQuery::~PreparedQuery() = default;
PreparedQuery::PreparedQuery(PreparedQuery&&) noexcept = default;
PreparedQuery& PreparedQuery::operator=(PreparedQuery&&) noexcept = default;

double PreparedQuery::collisionProbability(const fcl::Transform3d& pose_a,
                                           const fcl::Transform3d& pose_b,
                                           const GaussianDisplacement& displacement,
                                           const ProbabilityRequest& request,
                                           ProbabilityResult& result) const {
  validateRequest(request);
  detail::validatePose(pose_a, "object A");
  detail::validatePose(pose_b, "object B");
  result = implementation_->answer(pose_a, pose_b, displacement, request);
  return result.probability();
}

double collisionProbability(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                            const GaussianDisplacement& displacement,
                            const ProbabilityRequest& request, ProbabilityResult& result) {
  if (a == nullptr) throw InvalidGeometry("object A is null");
  if (b == nullptr) throw InvalidGeometry("object B is null");
  return collisionProbability(a->collisionGeometry().get(), a->getTransform(),
                              b->collisionGeometry().get(), b->getTransform(), displacement,
                              request, result);
}

double collisionProbability(const fcl::CollisionGeometryd* a, const fcl::Transform3d& pose_a,
                            const fcl::CollisionGeometryd* b, const fcl::Transform3d& pose_b,
                            const GaussianDisplacement& displacement,
                            const ProbabilityRequest& request, ProbabilityResult& result) {
  const auto unowned = [](const fcl::CollisionGeometryd* geometry) {
    return std::shared_ptr<const fcl::CollisionGeometryd>(std::shared_ptr<const void>(), geometry);
  };
  return PreparedQuery(unowned(a), unowned(b))
      .collisionProbability(pose_a, pose_b, displacement, request, result);
}

}  // namespace fcl_prob
