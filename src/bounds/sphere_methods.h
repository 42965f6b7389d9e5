// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Density times volume of the C-obstacle of two balls.
#pragma once

#include <Eigen/Core>

#include "convex/pair_frame.h"

namespace fcl_prob::detail {

/// \throws InvalidDistribution if the displacement does not move in all directions, so that it has
/// no density
void requireDensity(const GaussianDisplacement& displacement);

/// Displacements relative to the mean, world axes, metres.
struct DisplacementBall {
  Eigen::Vector3d centre;
  double radius;
};

/// The C-obstacle of two balls, each in the frame of its geometry.
inline DisplacementBall obstacleOf(const PairFrame& frame, const Eigen::Vector3d& centre_a,
                                   double radius_a, const Eigen::Vector3d& centre_b,
                                   double radius_b) {
  return {frame.rotation_b * centre_b - frame.rotation_a * centre_a + frame.offset,
          (radius_a + radius_b) * (1.0 + frame.ball_stretch)};
}

/// Density at the centre times volume.
double centralDensityTimesVolume(const DisplacementBall& ball, const PairFrame& frame);

/// Largest density times volume: at least the mass of the ball, rounding and PairFrame::error
/// included.
double largestDensityTimesVolume(const DisplacementBall& ball, const PairFrame& frame);

}  // namespace fcl_prob::detail
