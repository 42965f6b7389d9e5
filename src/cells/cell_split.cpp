// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/cell_split.h"

#include <algorithm>
#include <cmath>

namespace fcl_prob::detail {

namespace {

// A wider cell is cut this far from its end near the origin, where its mass is.
constexpr double kStep = 1.5;

// The first axis lies along the direction of closest approach, across the boundary, and that of the
// cell's plane leads across what is known to collide. Measured on the benchmark scenes: without the
// first weight 5 to 15 % more cells are needed, without the second 10 to 20 % more pair tests.
constexpr double kDepthWeight = 2.0;
constexpr double kPlaneWeight = 2.0;

// Narrower than this a cell's planes are within rounding of each other.
constexpr double kNarrowest = 1e-12;

double splitPoint(double lo, double hi) {
  if (lo < -kStep && hi > kStep) return 0.0;
  if (lo >= -kStep && hi > lo + 2 * kStep) return std::max(lo, 0.0) + kStep;
  if (hi <= kStep && lo < hi - 2 * kStep) return std::min(hi, 0.0) - kStep;
  return lo + 0.5 * (hi - lo);
}

}  // namespace

CellSplit chooseSplit(const Cell& cell, const Eigen::Vector3d& scales,
                      const Eigen::Vector3d& normal) {
  int axis = -1;
  double largest = 0.0;
  for (int i = 0; i < cell.rank; ++i) {
    // In the tail the density falls by e over 1 / |y|.
    const double nearest = std::max({cell.lo[i], -cell.hi[i], 1.0});
    const double across = std::fabs(normal[i]);
    const double weight = (i == 0 ? kDepthWeight : 1.0) * (1.0 + kPlaneWeight * across);
    const double width = cell.hi[i] - cell.lo[i];
    const double score = width / scales[i] * nearest * weight;
    if (score > largest && width > kNarrowest) {
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
