// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Slabs of C-obstacles whose pieces may be elsewhere.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "base/constants.h"
#include "convex/slab_kernels.h"

namespace fcl_prob::detail {

/// How far a slab's planes are moved.
struct SlabShift {
  double outward;
  double inward;
};

/// Moves the slabs outwards, and adds to their margins what the inside shrinks by.
/// \param shiftAlong  of a slab's normal (whitened frame): its SlabShift, rounded up
template <typename ShiftAlong>
void widenSlabs(double* data, int count, const ShiftAlong& shiftAlong) {
  for (int i = 0; i < count; ++i) {
    double& lo = data[3 * count + i];
    double& hi = data[4 * count + i];
    const Eigen::Vector3d n(data[i], data[count + i], data[2 * count + i]);
    if (hi >= kUnbounded || n.isZero(0.0)) continue;
    const SlabShift shift = shiftAlong(n);
    // Two sums for each end and two for the margin: an ε of its terms for each.
    const double rounding = 4 * kEpsilon * (std::fabs(lo) + std::fabs(hi) + shift.outward);
    const double out = shift.outward + rounding;
    lo -= out;
    hi += out;
    data[5 * count + i] += out + shift.inward + rounding;
  }
}

}  // namespace fcl_prob::detail
