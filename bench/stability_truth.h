// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Probabilities in 100 decimal digits that share no code with the library.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace fcl_prob::cli {

using Precise =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float_100::backend_type,
                                  boost::multiprecision::et_off>;

/// P lies in [lower, upper]; the two differ where the input is a rounded rotation.
struct Truth {
  Precise lower = 0;
  Precise upper = 0;
};

/// Mass of [lo, hi] under N(0, 1); 0 if hi <= lo.
Precise preciseIntervalMass(const Precise& lo, const Precise& hi);

/// Φ(x)
Precise preciseNormalMass(const Precise& x);

/// Mass of a ball of `radius` in a `distance` from the mean under N(0, I).
Precise preciseBallMass(const Precise& distance, const Precise& radius);

/// The displacement x along one axis touches if lo <= x <= hi. A deviation of 0: 1 if the
/// mean does, else 0; with `open` ends only strictly between them.
struct AxisRange {
  Precise lo, hi;  ///< relative to the mean, metres
  Precise sigma = 0;

  Precise mass(bool open = false) const;
};

/// Product over the axes.
Precise preciseBoxMass(const std::array<AxisRange, 3>& ranges, bool open = false);

/// Mass under N(0, diag(σx², σy²)) of what is below `top` and above the line through (x, y +
/// height) and (x + width, y), from x to x + width, relative to the mean. All terms are positive.
/// Gauss-Legendre along x, relative error below 1e-20.
struct SlantedStrip {
  Precise x, y, width, height, top;
  double sigma_x, sigma_y;

  Precise mass() const;
};

/// What a world vector has as coordinates along the columns of a matrix, without rounding: by
/// Cramer's rule, as the matrix is a rotation only to rounding.
std::array<Precise, 3> preciseCoordinates(const Eigen::Matrix3d& axes,
                                          const std::array<Precise, 3>& world);

}  // namespace fcl_prob::cli
