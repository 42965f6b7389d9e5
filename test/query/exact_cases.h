// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What tests of exact masses share.
#pragma once

#include "fcl_prob/fcl_prob.h"
#include "partition_query.h"
#include "poses.h"

namespace fcl_prob_test {

inline fcl_prob::ProbabilityResult answer(const fcl::CollisionGeometryd& a,
                                          const fcl::Transform3d& pose_a,
                                          const fcl::CollisionGeometryd& b,
                                          const fcl::Transform3d& pose_b,
                                          const fcl_prob::GaussianDisplacement& displacement,
                                          const fcl_prob::ProbabilityRequest& request = {}) {
  fcl_prob::ProbabilityResult result;
  fcl_prob::collisionProbability(&a, pose_a, &b, pose_b, displacement, request, result);
  return result;
}

}  // namespace fcl_prob_test
