// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Normal masses of polytopes by dense cubature: independent of the library's masses of polytopes.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace fcl_prob_test {

/// Mass under N(0, I) of the convex hull of some points: Gauss-Legendre over its sections with
/// parallel planes and over lines in each, between the heights of vertices, where everything is
/// smooth; exact along the lines. Relative error below kSliceCubatureError. Zero for points without
/// volume.
double massBySlices(const std::vector<Eigen::Vector3d>& points);

inline constexpr double kSliceCubatureError = 5e-3;

}  // namespace fcl_prob_test
