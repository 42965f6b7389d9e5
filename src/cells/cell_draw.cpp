// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/cell_draw.h"

#include <algorithm>
#include <cmath>

#include "base/quantiles.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob::detail {
namespace {

constexpr double kSqrt2 = 1.41421356237309504880;

// The axis along which the plane of a cell is steepest; -1 without a plane.
int steepestAxis(const OpenCell& open) {
  if (!open.hasPlane()) return -1;
  int steepest = 0;
  for (int k = 1; k < open.cell.rank; ++k) {
    if (std::fabs(open.plane.m[k]) > std::fabs(open.plane.m[steepest])) steepest = k;
  }
  return steepest;
}

}  // namespace

double truncatedNormal(double lo, double hi, double u) {
  if (lo + hi > 0) return -truncatedNormal(-hi, -lo, 1.0 - u);
  // On the side of the lower tail: Φ(y) = Φ(lo) + u (Φ(hi) - Φ(lo)).
  const double mass = normalTailMass(-lo) + u * normalIntervalMass(lo, hi);
  if (!(mass > 0.0)) return hi;
  const double y = -kSqrt2 * erfcInverseInDouble(2.0 * std::min(mass, 0.999999));
  return std::clamp(y, lo, hi);
}

CellDraw drawFrom(const OpenCell& open, const Eigen::Vector3d& uniform) {
  const Cell& cell = open.cell;
  CellDraw result{Eigen::Vector3d::Zero(), 1.0};
  const int steepest = steepestAxis(open);
  double along = 0.0;
  for (int k = 0; k < cell.rank; ++k) {
    if (k == steepest) continue;
    result.point[k] = truncatedNormal(cell.lo[k], cell.hi[k], uniform[k]);
    result.weight *= normalIntervalMass(cell.lo[k], cell.hi[k]);
    if (open.hasPlane()) along += open.plane.m[k] * result.point[k];
  }
  if (steepest < 0) return result;
  const double slope = open.plane.m[steepest];
  double lo = (open.possible_from - along) / slope;
  const double end = open.planeCovers() ? open.plane.s : 2 * kReach;
  double hi = (end - along) / slope;
  if (slope < 0) std::swap(lo, hi);
  lo = std::clamp(lo, cell.lo[steepest], cell.hi[steepest]);
  hi = std::clamp(hi, cell.lo[steepest], cell.hi[steepest]);
  result.weight *= normalIntervalMass(lo, hi);
  result.point[steepest] = hi > lo ? truncatedNormal(lo, hi, uniform[steepest]) : lo;
  return result;
}

// Between two planes the length along the steepest axis is the same everywhere, and no more mass
// than where the density is largest.
double largestWeight(const OpenCell& open) {
  constexpr double kLargestDensity = 0.39894228040143268;
  constexpr double kRounding = 1e-12;
  const int steepest = steepestAxis(open);
  double weight = 1.0 + kRounding;
  for (int k = 0; k < open.cell.rank; ++k) {
    double mass = normalIntervalMass(open.cell.lo[k], open.cell.hi[k]);
    if (k == steepest && open.planeCovers()) {
      const double nearest = std::clamp(0.0, open.cell.lo[k], open.cell.hi[k]);
      const double density = kLargestDensity * std::exp(-0.5 * nearest * nearest);
      const double length =
          (open.plane.s - open.possible_from) / std::fabs(open.plane.m[k]) + kRounding;
      mass = std::min(mass, length * density);
    }
    weight *= mass;
  }
  return weight;
}

}  // namespace fcl_prob::detail
