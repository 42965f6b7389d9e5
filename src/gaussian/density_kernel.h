// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The inner loop of cubatures over plain arrays of doubles: the normal density along a line.
#pragma once

namespace fcl_prob::detail {

inline constexpr int kMostDensityNodes = 20;
inline constexpr int kMostDensityLines = kMostDensityNodes * kMostDensityNodes;

/// Lines point + ρ direction, one in every column; their number is a multiple of four: those that
/// are not needed are points without weight.
struct DensityLines {
  int count = 0;
  double point[3][kMostDensityLines], direction[3][kMostDensityLines], weight[kMostDensityLines];
};

/// Values of ρ, and their weights.
struct DensityNodes {
  int count = 0;
  double rho[kMostDensityNodes], weight[kMostDensityNodes];
};

/// Of the points y of all nodes on all lines, with the products of their weights: Σ weight
/// exp(-|y|²/2), Σ weight y exp(-|y|²/2), and the largest |y|².
struct DensitySums {
  double sum = 0.0, moment[3] = {0.0, 0.0, 0.0}, farthest_square = 0.0;
};

/// A term is right to (|y|² + 40) 2^-52 of itself, and to 1e-307 of its weight.
DensitySums densityOfLines(const DensityLines& lines, const DensityNodes& nodes);

}  // namespace fcl_prob::detail
