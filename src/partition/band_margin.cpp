// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/band_margin.h"

#include <algorithm>
#include <cmath>

#include "partition/widen_slabs.h"

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
  widenSlabs(data, count, [&](const Eigen::Vector3d& n) {
    return SlabShift{outwardAlong(n, leaves), inwardAlong(n)};
  });
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
