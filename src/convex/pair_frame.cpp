// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/pair_frame.h"

#include <algorithm>
#include <limits>

#include "base/constants.h"
#include "geometry/exact_sum.h"
#include "geometry/length.h"
#include "geometry/validation.h"

namespace fcl_prob::detail {
namespace {

/// Roundings of a point's way to the whitened frame, in units of the largest coordinate on it:
/// about ten operations, the bounding volumes' own 4.5, the merging of parallel generators (45);
/// doubled.
constexpr double kRoundings = 128.0;

/// Sums and products below the smallest normal double.
constexpr double kTiny = 1e-300;

/// The fourth power of this, and what a sum of many of them has, is finite: lengths of products of
/// two whitened lengths are roots of such.
constexpr double kLargestWhitened = 1e75;

/// The coordinates that do not move are in about the largest length that there is, so that nothing
/// depends on the scale; a power of two, of which the square is finite.
double lengthUnit(double largest) { return powerOfTwoAt(std::clamp(largest, 1e-150, 1e150)); }

/// From the origin of A, displaced by the mean, to that of B. Exact but for one rounding: far
/// positions may cancel.
Eigen::Vector3d offsetBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                              const Eigen::Vector3d& mean) {
  ExactPosition offset;
  offset.add(b);
  offset.add(a, -1.0);
  offset.add(mean, -1.0);
  return offset.value().cast<double>();
}

/// A bound on the share by which a matrix that is a rotation only to 1e-9 changes lengths; 0 if it
/// is one to rounding, which kRoundings counts.
double stretchOf(const Eigen::Matrix3d& rotation) {
  const double defect =
      (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return defect > 16.0 * std::numeric_limits<double>::epsilon() ? 2.0 * defect : 0.0;
}

}  // namespace

PairFrame::PairFrame(const GaussianDisplacement& displacement, const fcl::Transform3d& pose_a,
                     double size_a, const fcl::Transform3d& pose_b, double size_b)
    : rank(displacement.rank()),
      principal_axes(displacement.axes()),
      rotation_a(pose_a.linear()),
      rotation_b(pose_b.linear()),
      same_rotation(rotation_a == rotation_b),
      ball_stretch(std::max(stretchOf(rotation_a), stretchOf(rotation_b))),
      offset(offsetBetween(pose_a.translation(), pose_b.translation(), displacement.mean())) {
  if (rank > 0) requireMeasurable(size_a, size_b);
  const double largest = size_a + size_b + lengthOf(offset);
  const double unit = lengthUnit(largest);
  whitening = Whitening(displacement, unit).matrix();
  for (int k = 0; k < 3; ++k) {
    const double scale = k < rank ? displacement.standardDeviations()[k] : unit;
    inverse_variances[k] = 1.0 / (scale * scale);
  }
  error =
      largest > 0.0 ? kRoundings * std::numeric_limits<double>::epsilon() * largest + kTiny : 0.0;
  fits = largest * whitening.cwiseAbs().maxCoeff() <= kLargestWhitened;
}

Eigen::Vector3d PairFrame::whitened(double error_in_metres) const {
  Eigen::Vector3d result;
  for (int k = 0; k < 3; ++k) result[k] = error_in_metres * whitening.row(k).norm();
  return result;
}

}  // namespace fcl_prob::detail
