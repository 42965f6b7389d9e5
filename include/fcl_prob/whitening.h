// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The frame in which the displacement is a standard normal.
#pragma once

#include <Eigen/Core>

#include "fcl_prob/gaussian_displacement.h"

namespace fcl_prob {

/// The affine map `y = W (ε - mean)` under which the first rank() coordinates of `y` are
/// independent standard normals and the remaining ones are zero. Any rotation among the first
/// rank() coordinates is free (the standard normal has no preferred axes); see rotatedTo().
///
/// Units: the first rank() coordinates are in standard deviations; a remaining coordinate is in
/// metres divided by `length_unit`, and every point that the displacement can reach has 0 there.
class Whitening {
 public:
  /// \param displacement  whose mean becomes the origin
  /// \param length_unit  metres, > 0: the scale of the coordinates that do not move.
  explicit Whitening(const GaussianDisplacement& displacement, double length_unit = 1.0);

  int rank() const { return rank_; }

  /// `y` of a displacement `ε` (metres, world frame).
  Eigen::Vector3d apply(const Eigen::Vector3d& displacement) const;

  /// `ε` of a whitened point.
  Eigen::Vector3d unapply(const Eigen::Vector3d& y) const;

  /// W: maps world-frame differences to whitened differences.
  const Eigen::Matrix3d& matrix() const { return matrix_; }

  /// W^{-1}.
  const Eigen::Matrix3d& inverse() const { return inverse_; }

  const Eigen::Vector3d& mean() const { return mean_; }

  /// The same whitening with its moving coordinates rotated so that the first one lies along the
  /// part of `direction` (whitened frame, need not be unit) that moves; unchanged if that part is
  /// zero or the rank is below 2.
  Whitening rotatedTo(const Eigen::Vector3d& direction) const;

 private:
  Eigen::Vector3d mean_;
  Eigen::Matrix3d matrix_;
  Eigen::Matrix3d inverse_;
  int rank_;
};

}  // namespace fcl_prob
