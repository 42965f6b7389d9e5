// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Moments of a standard normal variable within an interval.
#pragma once

namespace fcl_prob::detail {

/// What means may be wrong by.
inline constexpr double kMeanError = 1e-10;

struct CellMoments {
  double mean;      ///< to within kMeanError
  double variance;  ///< to within variance_error
  double variance_error;
  double third;  ///< upper bound on the absolute value of the third central moment
};

/// \param lo, hi  finite
CellMoments cellMoments(double lo, double hi);

}  // namespace fcl_prob::detail
