// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/collision_probability.h"

#include "fcl_prob/exceptions.h"
#include "fcl_prob/monte_carlo.h"
#include "geometry/validation.h"
#include "partition/partition.h"
#include "query/exact_mass.h"
#include "query/prepared_geometry.h"
#include "query/query_plan.h"
#include "query/single_collide.h"
#include "query/unbounded_pair.h"
#include "query/upper_bounds.h"

namespace fcl_prob {

struct PreparedQuery::Implementation {
  detail::PreparedGeometry a;
  detail::PreparedGeometry b;

  Implementation(std::shared_ptr<const fcl::CollisionGeometryd> geometry_a,
                 std::shared_ptr<const fcl::CollisionGeometryd> geometry_b)
      : a(std::move(geometry_a), "object A"), b(std::move(geometry_b), "object B") {}

  ProbabilityResult answer(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                           const GaussianDisplacement& displacement,
                           const ProbabilityRequest& request) const {
    const detail::QueryPlan plan = detail::planQuery(a, b, displacement, request);
    ProbabilityResult result = follow(plan, {a, pose_a, b, pose_b}, displacement, request);
    result.plan.insert(result.plan.begin(), plan.notes.begin(), plan.notes.end());
    return result;
  }

 private:
  ProbabilityResult follow(const detail::QueryPlan& plan, const detail::PlacedPair& pair,
                           const GaussianDisplacement& displacement,
                           const ProbabilityRequest& request) const;
  ProbabilityResult partition(const detail::QueryPlan& plan, const detail::PlacedPair& pair,
                              const GaussianDisplacement& displacement,
                              const ProbabilityRequest& request) const;
};

ProbabilityResult PreparedQuery::Implementation::follow(const detail::QueryPlan& plan,
                                                        const detail::PlacedPair& pair,
                                                        const GaussianDisplacement& displacement,
                                                        const ProbabilityRequest& request) const {
  using detail::Route;
  switch (plan.route) {
    case Route::single_collide:
      return detail::singleCollide(a.geometry(), pair.pose_a, b.geometry(), pair.pose_b,
                                   displacement.mean(), request);
    case Route::partition:
      return partition(plan, pair, displacement, request);
    case Route::unbounded_pair:
      return detail::unboundedPairProbability(pair, displacement, request);
    case Route::exact_mass:
      return detail::exactMass(pair, displacement, request);
    case Route::convex_bound:
      return detail::convexBound(pair, displacement, request);
    case Route::general_pcd:
      return detail::generalPcdBound(pair, displacement, request);
    case Route::monte_carlo:
      return monteCarloProbability(a.geometry(), pair.pose_a, b.geometry(), pair.pose_b,
                                   displacement, request);
    case Route::rare_event:
      return rareEventProbability(a.geometry(), pair.pose_a, b.geometry(), pair.pose_b,
                                  displacement, request);
  }
  throw InvalidRequest("no such route");
}

ProbabilityResult PreparedQuery::Implementation::partition(
    const detail::QueryPlan& plan, const detail::PlacedPair& pair,
    const GaussianDisplacement& displacement, const ProbabilityRequest& request) const {
  // Open meshes are refused wherever the shapes are.
  const detail::ClosedMesh* const solid_a = a.solid(request.contact);
  const detail::ClosedMesh* const solid_b = b.solid(request.contact);
  if (plan.try_root_bound) {
    auto result = detail::intervalOfRootBound(pair, displacement, request);
    if (result) return *result;
  }
  return detail::partitionProbability({&a.pieces(), {{pair.pose_a, solid_a}}},
                                      {&b.pieces(), {{pair.pose_b, solid_b}}}, displacement,
                                      request);
}

PreparedQuery::PreparedQuery(std::shared_ptr<const fcl::CollisionGeometryd> a,
                             std::shared_ptr<const fcl::CollisionGeometryd> b)
    : implementation_(std::make_unique<Implementation>(std::move(a), std::move(b))) {}

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
