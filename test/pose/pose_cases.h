// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What tests of pose errors share.
#pragma once

#include "fcl_prob/pose_probability.h"
#include "random_bodies.h"

namespace fcl_prob_test {

inline fcl::Transform3d poseAt(double x, double y, double z) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}

/// F Fᵀ of a random factor of so many columns: metres of about `length`, radians of about `angle`.
inline fcl_prob::PoseError::Matrix6 randomPoseCovariance(RandomBodies& random, int rank,
                                                         double length, double angle) {
  Eigen::Matrix<double, 6, Eigen::Dynamic> factor(6, rank);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < rank; ++column) {
      factor(row, column) = (row < 3 ? length : angle) * random.normal() / std::sqrt(rank);
    }
  }
  return factor * factor.transpose();
}

inline fcl_prob::ProbabilityRequest poseRequest(fcl_prob::ProbabilityMethod method,
                                                double relative_tolerance = 0.01) {
  fcl_prob::ProbabilityRequest request;
  request.method = method;
  request.relative_tolerance = relative_tolerance;
  request.absolute_tolerance = 1e-6;
  return request;
}

}  // namespace fcl_prob_test
