// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// From the frames of two geometries to the whitened frame of their displacement.
#pragma once

#include <fcl/common/types.h>

#include <Eigen/Core>

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/whitening.h"

namespace fcl_prob::detail {

/// The displacement ε = b - a of two points that touch, seen from the mean: with a and b in the
/// frames of their geometries, x = R_b b - R_a a + offset (world axes, metres) and y = W x
/// (whitened).
struct PairFrame {
  /// \param size_a, size_b  no coordinate of a point used is larger (metres, own frame); they set
  /// how
  ///                        far rounding can move a point.
  /// \throws InvalidGeometry if both are below kLeastSize and one of them is not 0
  PairFrame(const GaussianDisplacement& displacement, const fcl::Transform3d& pose_a, double size_a,
            const fcl::Transform3d& pose_b, double size_b);

  Eigen::Matrix3d whitening;
  int rank;

  /// Principal axes of the displacement as columns (world), and the inverse variances along them.
  Eigen::Matrix3d principal_axes;
  Eigen::Vector3d inverse_variances;

  Eigen::Matrix3d rotation_a;
  Eigen::Matrix3d rotation_b;
  bool same_rotation;

  /// By at most this share of its radius a ball differs from its image under the rotations, which
  /// are some only to 1e-9; 0 where they are to rounding.
  double ball_stretch;

  Eigen::Vector3d offset;

  /// No computed point x is farther from the true one than this (metres), padding of FCL's bounding
  /// volumes included, which miss their own contents by 1e-15 of their size.
  double error;

  /// Whether products of four whitened lengths stay finite. Where they do not (a standard
  /// deviation of 1e-75 of the objects' size), nothing is known of P from this frame.
  bool fits;

  /// By how much an error of so many metres can change each whitened coordinate.
  Eigen::Vector3d whitened(double error_in_metres) const;
};

}  // namespace fcl_prob::detail
