// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/band_margin.h"

#include <cmath>

#include "gaussian/constants.h"

namespace fcl_prob::detail {
namespace {

// Shares of the band's thickness: of the widths of a cell that is small beside it, and of a layer
// that is not worth making thinner.
constexpr double kSmallCell = 0.7;
constexpr double kThinnestLayer = 1.2;

}  // namespace

void BandMargin::widen(double* data, int count) const {
  for (int i = 0; i < count; ++i) {
    double& lo = data[3 * count + i];
    double& hi = data[4 * count + i];
    const Eigen::Vector3d n(data[i], data[count + i], data[2 * count + i]);
    if (hi >= kUnbounded || n.isZero(0.0)) continue;
    const double rounding = 4 * kEpsilon * (std::fabs(lo) + std::fabs(hi));
    const double out = outwardAlong(n) + rounding;
    lo -= out;
    hi += out;
    data[5 * count + i] += out + inwardAlong(n) + rounding;
  }
}

bool BandMargin::isAllThatIsLeft(const OpenCell& open) const {
  const double thickness = outward_ + inward_;
  bool small = true;
  for (int k = 0; k < open.cell.rank && small; ++k) {
    const double band = thickness * lengthOf(Eigen::Vector3d::Unit(k));
    small = open.cell.hi[k] - open.cell.lo[k] <= kSmallCell * band;
  }
  if (small) return true;
  if (!open.plane_covers) return false;
  const double layer = open.plane.s - open.possible_from;
  return layer <= kThinnestLayer * thickness * lengthOf(open.plane.m);
}

}  // namespace fcl_prob::detail
