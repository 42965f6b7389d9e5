// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What a covariance matrix may be off by, and how large it may be.
#pragma once

namespace fcl_prob::detail {

/// Entries across the diagonal may differ by this share of the largest.
inline constexpr double kSymmetryTolerance = 1e-9;

/// What rounding leaves of a zero eigenvalue, as a share of the largest entry.
inline constexpr double kDefinitenessTolerance = 1e-12;

/// Of an entry: sums of a few of them, as eigenvalues are, stay finite.
inline constexpr double kLargestCovariance = 1e300;

}  // namespace fcl_prob::detail
