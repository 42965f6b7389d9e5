// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/band_margin.h"

#include <algorithm>
#include <cmath>

#include "gaussian/constants.h"

namespace fcl_prob::detail {
namespace {

// Shares of the band's thickness: of the widths of a cell that is small beside it, and of a layer
// that is not worth making thinner.
constexpr double kSmallCell = 0.7;
constexpr double kThinnestLayer = 1.2;

}  // namespace

double BandMargin::outwardAlong(const Eigen::Vector3d& m, NodePair nodes) const {
  const double band = outward_ * lengthOf(m);
  if (of_a_.isEmpty() && of_b_.isEmpty()) return band;
  const Eigen::Vector3d n = metres_ * m;
  return (1.0 + 1e-12) * (band + of_a_.along(n, nodes.a) + of_b_.along(n, nodes.b));
}

void BandMargin::widen(double* data, int count, NodePair leaves) const {
  for (int i = 0; i < count; ++i) {
    double& lo = data[3 * count + i];
    double& hi = data[4 * count + i];
    const Eigen::Vector3d n(data[i], data[count + i], data[2 * count + i]);
    if (hi >= kUnbounded || n.isZero(0.0)) continue;
    const double outward = outwardAlong(n, leaves);
    const double rounding = 4 * kEpsilon * (std::fabs(lo) + std::fabs(hi) + outward);
    const double out = outward + rounding;
    lo -= out;
    hi += out;
    data[5 * count + i] += out + inwardAlong(n) + rounding;
  }
}

// Of the pairs that may meet the cell, the thickest.
double BandMargin::thicknessAlong(const Eigen::Vector3d& m, const OpenCell& open) const {
  if (of_a_.isEmpty() && of_b_.isEmpty()) return (outward_ + inward_) * lengthOf(m);
  double most = 0.0;
  for (const FrontPair& pair : open.front) {
    if (!pair.isHalfSpace()) most = std::max(most, outwardAlong(m, pair.nodes));
  }
  return most;
}

bool BandMargin::isAllThatIsLeft(const OpenCell& open) const {
  bool small = true;
  for (int k = 0; k < open.cell.rank && small; ++k) {
    const double band = thicknessAlong(Eigen::Vector3d::Unit(k), open);
    small = open.cell.hi[k] - open.cell.lo[k] <= kSmallCell * band;
  }
  if (small) return true;
  if (!open.plane_covers) return false;
  const double layer = open.plane.s - open.possible_from;
  return layer <= kThinnestLayer * thicknessAlong(open.plane.m, open);
}

}  // namespace fcl_prob::detail
