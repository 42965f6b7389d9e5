// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cobstacle/pair_frame.h"

#include <limits>

namespace fcl_prob::detail {
namespace {

/// Roundings of a point's way to the whitened frame, in units of the largest coordinate on it:
/// about ten operations, the bounding volumes' own 4.5, the merging of parallel generators (45);
/// doubled.
constexpr double kRoundings = 128.0;

/// The cube of this, and what a sum of many of them has, is finite.
constexpr double kLargestWhitened = 1e100;

/// The coordinates that do not move are in metres.
constexpr double kLengthUnit = 1.0;

}  // namespace

PairFrame::PairFrame(const GaussianDisplacement& displacement, const fcl::Transform3d& pose_a,
                     double size_a, const fcl::Transform3d& pose_b, double size_b)
    : rank(displacement.rank()),
      principal_axes(displacement.axes()),
      rotation_a(pose_a.linear()),
      rotation_b(pose_b.linear()),
      same_rotation(rotation_a == rotation_b),
      offset((pose_b.translation() - pose_a.translation()) - displacement.mean()) {
  whitening = Whitening(displacement, kLengthUnit).matrix();
  for (int k = 0; k < 3; ++k) {
    const double scale = k < rank ? displacement.standardDeviations()[k] : kLengthUnit;
    inverse_variances[k] = 1.0 / (scale * scale);
  }
  const double largest = size_a + size_b + pose_a.translation().norm() +
                         pose_b.translation().norm() + displacement.mean().norm();
  error = kRoundings * std::numeric_limits<double>::epsilon() * largest;
  fits = largest * whitening.cwiseAbs().maxCoeff() <= kLargestWhitened;
}

Eigen::Vector3d PairFrame::whitened(double error_in_metres) const {
  Eigen::Vector3d result;
  for (int k = 0; k < 3; ++k) result[k] = error_in_metres * whitening.row(k).norm();
  return result;
}

}  // namespace fcl_prob::detail
