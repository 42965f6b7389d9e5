// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/single_collide.h"

#include "base/decision.h"
#include "geometry/displaced_collider.h"

namespace fcl_prob::detail {

ProbabilityResult singleCollide(const fcl::CollisionGeometryd& a, const fcl::Transform3d& pose_a,
                                const fcl::CollisionGeometryd& b, const fcl::Transform3d& pose_b,
                                const Eigen::Vector3d& displacement,
                                const ProbabilityRequest& request) {
  const DisplacedCollider collider(a, pose_a, b, pose_b, request.contact);
  const double probability = collider.collides(displacement) ? 1.0 : 0.0;
  ProbabilityResult result;
  result.method = ProbabilityMethod::exact;
  result.lower = probability;
  result.upper = probability;
  result.status = ProbabilityStatus::exact;
  result.decision = decisionOf({probability, probability}, request);
  return result;
}

}  // namespace fcl_prob::detail
