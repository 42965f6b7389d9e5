// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/pose_probability.h"

#include <fcl/geometry/shape/sphere.h>

#include "base/refuse_band.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/monte_carlo.h"
#include "fcl_prob/prior_methods.h"
#include "geometry/validation.h"
#include "pose/configuration_estimate.h"
#include "pose/pose_interval.h"
#include "query/pair_query.h"

namespace fcl_prob {
namespace {

std::shared_ptr<const fcl::CollisionGeometryd> unowned(const fcl::CollisionGeometryd* geometry) {
  return {std::shared_ptr<const void>(), geometry};
}

ProbabilityResult farApart(double bound, const ProbabilityRequest& request) {
  ProbabilityResult result;
  result.method = ProbabilityMethod::estimate;
  result.lower = 0.0;
  result.upper = bound;
  result.estimate = result.standard_error = 0.5 * bound;
  result.confidence_interval = Bounds{0.0, bound};
  result.decision = request.threshold ? Decision::below : Decision::none;
  result.status = request.threshold ? ProbabilityStatus::decided : ProbabilityStatus::converged;
  result.plan.emplace_back("a ball around all that A can turn to hardly meets B: certified");
  return result;
}

[[noreturn]] void refuse(ProbabilityMethod method) {
  throw UnsupportedGeometry("method " + toString(method) +
                            " has no answer for errors of a rotation");
}

}  // namespace

struct PreparedPoseQuery::Implementation {
  std::shared_ptr<const detail::PreparedGeometry> a;
  std::shared_ptr<const detail::PreparedGeometry> b;
  detail::PairQuery pair;

  Implementation(std::shared_ptr<const fcl::CollisionGeometryd> geometry_a,
                 std::shared_ptr<const fcl::CollisionGeometryd> geometry_b)
      : a(std::make_shared<const detail::PreparedGeometry>(std::move(geometry_a), "object A")),
        b(std::make_shared<const detail::PreparedGeometry>(std::move(geometry_b), "object B")),
        pair(a, b) {}

  /// However A turns about its frame's origin it stays within a ball around that: an upper bound,
  /// certified, whatever the rotation's error is. 1 where there is none.
  double ballBound(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                   const PoseError& error) const {
    const PoseError in_world = error.inWorldFrame(pose_a);
    const bool turns_about_origin = in_world.convention() == PoseConvention::world_rotation_vector;
    if (!turns_about_origin || !a->hasPieces() || !b->hasPieces()) return 1.0;
    const BoundingSphere of_a = boundingSphere(a->geometry());
    const double radius = (of_a.centre.norm() + of_a.radius) * (1.0 + 1e-9);
    const auto ball = std::make_shared<const detail::PreparedGeometry>(
        std::make_shared<fcl::Sphered>(radius), "object A");
    const fcl::Transform3d pose(Eigen::Translation3d(pose_a.translation()));
    ProbabilityRequest request;
    request.method = ProbabilityMethod::convex_pcd;
    return *detail::PairQuery(ball, b).answer(pose, pose_b, in_world.translation(), request).upper;
  }

  ProbabilityResult estimateOrBound(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                                    const PoseError& error, const RandomPoses& poses,
                                    const ProbabilityRequest& request) const {
    const double bound = request.gradient ? 1.0 : ballBound(pose_a, pose_b, error);
    const bool is_enough =
        request.threshold ? bound < *request.threshold : bound <= request.absolute_tolerance;
    return is_enough ? farApart(bound, request) : estimate(poses, request);
  }

  ProbabilityResult estimate(const RandomPoses& poses, const ProbabilityRequest& request) const {
    const auto answer = [this](const PlacedConfiguration& placed,
                               const ProbabilityRequest& of_one) {
      return pair.answer(placed.poses_a[0], placed.poses_b[0], placed.displacement, of_one);
    };
    return detail::configurationEstimate(detail::ConfigurationMixture({{1.0, &poses}}), answer,
                                         {unowned(&a->geometry())}, {unowned(&b->geometry())},
                                         request);
  }
};

PreparedPoseQuery::PreparedPoseQuery(std::shared_ptr<const fcl::CollisionGeometryd> a,
                                     std::shared_ptr<const fcl::CollisionGeometryd> b)
    : implementation_(std::make_unique<Implementation>(std::move(a), std::move(b))) {}

PreparedPoseQuery::~PreparedPoseQuery() = default;
PreparedPoseQuery::PreparedPoseQuery(PreparedPoseQuery&&) noexcept = default;
PreparedPoseQuery& PreparedPoseQuery::operator=(PreparedPoseQuery&&) noexcept = default;

double PreparedPoseQuery::collisionProbability(const fcl::Transform3d& pose_a,
                                               const fcl::Transform3d& pose_b,
                                               const PoseError& error,
                                               const ProbabilityRequest& request,
                                               ProbabilityResult& result) const {
  validateRequest(request);
  detail::validatePose(pose_a, "object A");
  detail::validatePose(pose_b, "object B");
  const RandomPoses poses = RandomPoses::ofOne(pose_a, error, pose_b);
  if (poses.dimension() == 0) {
    const PlacedConfiguration placed = poses.at(Eigen::VectorXd());
    result = implementation_->pair.answer(placed.poses_a[0], placed.poses_b[0], placed.displacement,
                                          request);
    return result.probability();
  }
  detail::refuseBand(request, "errors of a rotation");
  switch (request.method) {
    case ProbabilityMethod::automatic:
    case ProbabilityMethod::estimate:
      result = implementation_->estimateOrBound(pose_a, pose_b, error, poses, request);
      break;
    case ProbabilityMethod::rare_event:
      result = implementation_->estimate(poses, request);
      break;
    case ProbabilityMethod::interval:
      result = detail::poseInterval(*implementation_->a, pose_a, *implementation_->b, pose_b, error,
                                    request);
      break;
    case ProbabilityMethod::monte_carlo:
      result = poseMonteCarloProbability(implementation_->a->geometry(), pose_a,
                                         implementation_->b->geometry(), pose_b, error, request);
      break;
    default:
      refuse(request.method);
  }
  return result.probability();
}

double collisionProbability(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                            const PoseError& error, const ProbabilityRequest& request,
                            ProbabilityResult& result) {
  if (a == nullptr) throw InvalidGeometry("object A is null");
  if (b == nullptr) throw InvalidGeometry("object B is null");
  return collisionProbability(a->collisionGeometry().get(), a->getTransform(),
                              b->collisionGeometry().get(), b->getTransform(), error, request,
                              result);
}

double collisionProbability(const fcl::CollisionGeometryd* a, const fcl::Transform3d& pose_a,
                            const fcl::CollisionGeometryd* b, const fcl::Transform3d& pose_b,
                            const PoseError& error, const ProbabilityRequest& request,
                            ProbabilityResult& result) {
  return PreparedPoseQuery(unowned(a), unowned(b))
      .collisionProbability(pose_a, pose_b, error, request, result);
}

}  // namespace fcl_prob
