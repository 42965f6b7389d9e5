// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/band_margin.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "scene/widen_slabs.h"

namespace fcl_prob::detail {
namespace {

/// Of a direction's length, for a gradient that only steers.
constexpr double kDifference = 1e-4;

}  // namespace

double BandMargin::outwardAlong(const Eigen::Vector3d& m, NodePair nodes) const {
  const double band = outward_ * lengthOf(m);
  if (of_a_.isEmpty() && of_b_.isEmpty()) return band;
  const Eigen::Vector3d n = metres_ * m;
  return (1.0 + 1e-12) * (band + of_a_.along(n, nodes.a) + of_b_.along(n, nodes.b));
}

// A support function has its farthest point for a gradient.
Eigen::Vector3d BandMargin::wayAlong(const Eigen::Vector3d& m, NodePair nodes) const {
  const double step = kDifference * m.norm();
  Eigen::Vector3d way;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d aside = step * Eigen::Vector3d::Unit(k);
    way[k] = (outwardAlong(m + aside, nodes) - outwardAlong(m - aside, nodes)) / (2.0 * step);
  }
  return way;
}

void BandMargin::widen(double* data, int count, NodePair leaves) const {
  widenSlabs(data, count, [&](const Eigen::Vector3d& n) {
    // What sweeps may fill counts as V.
    const double outward = outwardAlong(n, leaves);
    return SlabShift{outward, isOfSweeps() ? -outward : inwardAlong(n)};
  });
}

}  // namespace fcl_prob::detail
