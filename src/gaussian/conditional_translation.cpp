// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "gaussian/conditional_translation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "gaussian/principal_axes.h"

namespace fcl_prob::detail {
namespace {

// What rounding of the products and the difference may leave of a variance that is zero, in units
// of kEpsilon times the variance before and the square of the ratio of the rotation's deviations:
// of a ratio up to this one.
constexpr double kCancellation = 64.0;
constexpr double kLargestRatio = 1e3;

// Σ_tt - C Cᵀ, in which variances that cancel are zero.
GaussianDisplacement residualOf(const GaussianDisplacement& whole, const Eigen::Matrix3d& explained,
                                double ratio) {
  if (explained.isZero(0)) return whole;
  const Eigen::Matrix3d difference = whole.covariance() - explained;
  const PrincipalAxes axes =
      principalAxesOfCovariance(0.5 * difference + 0.5 * difference.transpose());
  const Eigen::Vector3d reach = whole.covariance().diagonal().cwiseMax(0.0).cwiseSqrt();
  const double rounding = std::min(ratio, kLargestRatio) * std::sqrt(kCancellation * kEpsilon);
  Eigen::Vector3d deviations = axes.standard_deviations;
  for (int k = 0; k < 3; ++k) {
    const double before = axes.axes.col(k).cwiseAbs().dot(reach);
    if (deviations[k] <= rounding * before) deviations[k] = 0.0;
  }
  return GaussianDisplacement::fromStandardDeviations(deviations, Eigen::Quaterniond(axes.axes),
                                                      whole.mean());
}

}  // namespace

ConditionalTranslation::ConditionalTranslation(const PoseError& error)
    : mean_rotation_(error.mean().tail<3>()) {
  const PrincipalAxes axes =
      principalAxesOfCovariance(error.covariance().bottomRightCorner<3, 3>());
  factor_ = axes.axes.leftCols(axes.rank) * axes.standard_deviations.head(axes.rank).asDiagonal();
  slope_ = error.covariance().topRightCorner<3, 3>() * axes.axes.leftCols(axes.rank) *
           axes.standard_deviations.head(axes.rank).cwiseInverse().asDiagonal();
  const double ratio =
      axes.rank == 0 ? 1.0 : axes.standard_deviations[0] / axes.standard_deviations[axes.rank - 1];
  residual_ = residualOf(error.translation(), slope_ * slope_.transpose(), ratio);
}

void ConditionalTranslation::turn(const Eigen::MatrixXd& q) {
  factor_ = (factor_ * q).eval();
  slope_ = (slope_ * q).eval();
}

Eigen::Vector3d ConditionalTranslation::rotationVector(const Eigen::VectorXd& z) const {
  // Eigen steps beyond the null pointer of a matrix without columns.
  if (rank() == 0) return mean_rotation_;
  return mean_rotation_ + factor_ * z;
}

GaussianDisplacement ConditionalTranslation::translation(const Eigen::VectorXd& z) const {
  return rank() == 0 ? residual_ : residual_.withMean(residual_.mean() + slope_ * z);
}

}  // namespace fcl_prob::detail
