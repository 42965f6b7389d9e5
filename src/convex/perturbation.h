// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Tiny reproducible displacements that decide ties.
#pragma once

#include <Eigen/Core>

namespace fcl_prob::detail {

/// How many different perturbations are tried before a surface is given up; the first is none.
inline constexpr int kPerturbationAttempts = 5;

/// Ties (parallel faces, coplanar edges) are decided as if the bodies were moved by such vectors
/// times their size: "in general position", reproducible, about 1e-11 long, which is far above
/// rounding, so that all decisions fit together. No vertex is moved: only the choice among nearly
/// coplanar facets depends on it. Zero for attempt 0.
Eigen::Vector3d perturbation(int index, int attempt);

/// perturbation() is never longer than this.
inline constexpr double kLargestPerturbation = 0x1p-35;

}  // namespace fcl_prob::detail
