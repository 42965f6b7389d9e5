// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/collision_probability.h"

#include "fcl_prob/exceptions.h"
#include "fcl_prob/mixture.h"
#include "query/pair_query.h"

namespace fcl_prob {

struct PreparedQuery::Implementation {
  detail::PairQuery pair;

  Implementation(std::shared_ptr<const fcl::CollisionGeometryd> a,
                 std::shared_ptr<const fcl::CollisionGeometryd> b)
      : pair(std::make_shared<const detail::PreparedGeometry>(std::move(a), "object A"),
             std::make_shared<const detail::PreparedGeometry>(std::move(b), "object B")) {}
};

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
  result = implementation_->pair.answer(pose_a, pose_b, displacement, request);
  return result.probability();
}

double collisionProbability(const PreparedQuery& query, const fcl::Transform3d& pose_a,
                            const fcl::Transform3d& pose_b, const TruncatedGaussian& displacement,
                            const ProbabilityRequest& request, ProbabilityResult& result) {
  result = query.implementation_->pair.answer(pose_a, pose_b, displacement, request);
  return result.probability();
}

double collisionProbability(const PreparedQuery& query, const fcl::Transform3d& pose_a,
                            const fcl::Transform3d& pose_b, const GaussianMixture& displacement,
                            const ProbabilityRequest& request, ProbabilityResult& result) {
  result = query.implementation_->pair.answer(pose_a, pose_b, displacement, request);
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
