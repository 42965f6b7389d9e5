// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/whitening.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/number_text.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob {
namespace {

// Rotation of the first `rank` coordinates whose first row is the unit vector `first`.
Eigen::Matrix3d rotationOfMovingCoordinates(const Eigen::Vector3d& first, int rank) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  if (rank == 2) {
    rotation.row(0) << first.x(), first.y(), 0;
    rotation.row(1) << -first.y(), first.x(), 0;
    return rotation;
  }
  const Eigen::Vector3d second = first.unitOrthogonal();
  rotation.row(0) = first.transpose();
  rotation.row(1) = second.transpose();
  rotation.row(2) = first.cross(second).transpose();
  return rotation;
}

}  // namespace

Whitening::Whitening(const GaussianDisplacement& displacement, double length_unit)
    : mean_(displacement.mean()), rank_(displacement.rank()) {
  if (!(length_unit > 0) || !std::isfinite(length_unit)) {
    throw InvalidDistribution("length unit of the whitened frame is not positive and finite: " +
                              detail::numberText(length_unit));
  }
  Eigen::Vector3d scale = displacement.standardDeviations();
  for (int k = rank_; k < 3; ++k) scale[k] = length_unit;
  matrix_ = scale.cwiseInverse().asDiagonal() * displacement.axes().transpose();
  inverse_ = displacement.axes() * scale.asDiagonal();
}

Eigen::Vector3d Whitening::apply(const Eigen::Vector3d& displacement) const {
  return matrix_ * (displacement - mean_);
}

Eigen::Vector3d Whitening::unapply(const Eigen::Vector3d& y) const { return mean_ + inverse_ * y; }

Whitening Whitening::rotatedTo(const Eigen::Vector3d& direction) const {
  if (rank_ < 2) return *this;
  Eigen::Vector3d moving = direction;
  for (int k = rank_; k < 3; ++k) moving[k] = 0;
  moving = moving.stableNormalized();
  if (!(moving.squaredNorm() > 0.5)) return *this;

  const Eigen::Matrix3d rotation = rotationOfMovingCoordinates(moving, rank_);
  Whitening result = *this;
  result.matrix_ = rotation * matrix_;
  result.inverse_ = inverse_ * rotation.transpose();
  return result;
}

}  // namespace fcl_prob
