// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What tests of pose errors share.
#pragma once

#include <fcl/geometry/shape/box.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <memory>

#include "fcl_prob/pose_probability.h"
#include "poses.h"
#include "random_bodies.h"

namespace fcl_prob_test {

inline double normalCdf(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

/// E f(σ z) for a standard normal z.
template <typename Function>
double gaussianMean(double sigma, const Function& f) {
  const auto integrand = [&](double z) {
    return f(sigma * z) * std::exp(-0.5 * z * z) * 0.39894228040143268;
  };
  return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(integrand, -9.0, 9.0, 12,
                                                                       1e-12);
}

inline fcl_prob::PreparedPoseQuery boxes() {
  return {std::make_shared<fcl::Boxd>(1.0, 0.4, 0.2), std::make_shared<fcl::Boxd>(0.5, 0.8, 0.6)};
}

inline fcl_prob::ProbabilityResult answer(const fcl_prob::PreparedPoseQuery& query,
                                          const fcl::Transform3d& pose_a,
                                          const fcl::Transform3d& pose_b,
                                          const fcl_prob::PoseError& error,
                                          const fcl_prob::ProbabilityRequest& request) {
  fcl_prob::ProbabilityResult result;
  query.collisionProbability(pose_a, pose_b, error, request, result);
  return result;
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
