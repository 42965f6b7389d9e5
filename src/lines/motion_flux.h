// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How P changes as the parts of A move, from random lines through the displacement space.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "fcl_prob/gaussian_displacement.h"
#include "scene/partition_object.h"

namespace fcl_prob::detail {

/// What parts do while some parameters change: a column for each of these, of the velocity of the
/// point of the part that is at the world's origin (metres) and the angular velocity (radians).
using PartVelocities = std::vector<Eigen::Matrix<double, 6, Eigen::Dynamic>>;

/// Means over lines and their standard errors, six of which hold but for a chance of 1e-6 however
/// few lines tell (see BoundedMean).
struct MeanAndError {
  Eigen::VectorXd mean;
  Eigen::VectorXd standard_error;
  std::size_t lines = 0;
};

struct LineDraws {
  std::size_t count;  ///< at least 2
  std::uint64_t seed;
  unsigned threads;

  /// Asked now and then by the calling thread, with the number of lines that are drawn, while some
  /// are left; the first few are drawn in any case. Empty: always.
  std::function<bool(std::size_t)> go_on;
};

/// P, and behind it ∂P/∂parameter for every column of the velocities: estimates. Of a displacement
/// of rank 1 there is one line, which has it all.
///
/// On a line the C-obstacles are intervals, whose mass is known. Lines of random direction meet the
/// boundary of their union evenly but for a factor that is the same everywhere (Crofton's formula):
/// the sum over the ends of the intervals, weighted with the density, is the flux of what moves
/// through the boundary, and that is what P changes by. In three dimensions and with whitened
/// coordinates: ∂P/∂θ = 2 E Σ φ(s) (-n·W v_A(θ)), v_A the velocity of the touching point of A.
/// More lines are drawn where parts of A may touch, each counted by how frequent it is (PartLines).
///
/// \param displacement  not of rank 0
/// \param velocities    of the parts of A, in their order, all with as many columns
MeanAndError motionFlux(const PartitionObject& a, const PartitionObject& b,
                        const GaussianDisplacement& displacement, const PartVelocities& velocities,
                        const LineDraws& draws);

}  // namespace fcl_prob::detail
