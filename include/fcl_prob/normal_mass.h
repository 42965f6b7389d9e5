// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Masses of the standard normal distribution that keep their relative accuracy far into the tails.
#pragma once

#include <Eigen/Core>

#include "fcl_prob/bounds.h"

namespace fcl_prob {

/// Φ(-h): the mass of the half-space { m·y >= h }, |m| = 1. Relative accuracy a few ulp for every h
/// for which the result is a normal double; h may be infinite.
double normalTailMass(double h);

/// Mass of [lo, hi] under N(0, 1): 0 if hi <= lo; the ends may be infinite. Computed on the side of
/// the tail, so that it keeps about 1e-15 relative accuracy down to 1e-300; for intervals far
/// narrower than 1 it does not cancel either.
double normalIntervalMass(double lo, double hi);

/// ∫ y φ(y) dy over [lo, hi]: φ(lo) - φ(hi), without cancellation; 0 if hi <= lo. Relative accuracy
/// as that of normalIntervalMass() except for the rounding of lo + hi.
double normalIntervalMoment(double lo, double hi);

/// Mass of the box [lo, hi] under N(0, I): the product of three interval masses.
double normalBoxMass(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi);

/// Mass of the ball |y - centre| <= radius under N(0, I), with |centre| = distance, certified:
/// closed form of the noncentral chi-square distribution with three degrees of freedom, or an
/// integral over discs where that cancels. Relative width below 1e-12 for every distance and radius
/// with a mass above 1e-290. \throws InvalidGeometry if an argument is negative or NaN.
Bounds normalBallMass(double distance, double radius);

/// Relative rounding error that no mass or moment of an interval exceeds while it is above 1e-300;
/// a certified result is widened by a multiple of it (a box: three times). Below 1e-300 the
/// absolute error is what matters: it is less than 1e-300.
inline constexpr double kIntervalMassRelativeError = 16 * 2.220446049250313e-16;

}  // namespace fcl_prob
