// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/cell_split.h"

#include <algorithm>

namespace fcl_prob::detail {

namespace {

// A wider cell is cut this far from its end near the origin, where its mass is.
constexpr double kStep = 1.5;

// The first axis lies along the direction of closest approach, across the boundary. Measured: 1.5
// takes 5 to 15 % fewer cells than 1, 0.6 takes up to 45 % more.
constexpr double kDepthWeight = 1.5;

// Narrower than this a cell's planes are within rounding of each other.
constexpr double kNarrowest = 1e-12;

double splitPoint(double lo, double hi) {
  if (lo < -kStep && hi > kStep) return 0.0;
  if (lo >= -kStep && hi > lo + 2 * kStep) return std::max(lo, 0.0) + kStep;
  if (hi <= kStep && lo < hi - 2 * kStep) return std::min(hi, 0.0) - kStep;
  return lo + 0.5 * (hi - lo);
}

}  // namespace

CellSplit chooseSplit(const Cell& cell) {
  int axis = -1;
  double largest = kNarrowest;
  for (int i = 0; i < cell.rank; ++i) {
    // In the tail the density falls by e over 1 / |y|.
    const double nearest = std::max({cell.lo[i], -cell.hi[i], 1.0});
    const double score = (cell.hi[i] - cell.lo[i]) * nearest * (i == 0 ? kDepthWeight : 1.0);
    if (score > largest) {
      largest = score;
      axis = i;
    }
  }
  if (axis < 0) return {-1, 0.0};
  const double at = splitPoint(cell.lo[axis], cell.hi[axis]);
  if (!(at > cell.lo[axis] && at < cell.hi[axis])) return {-1, 0.0};
  return {axis, at};
}

}  // namespace fcl_prob::detail
