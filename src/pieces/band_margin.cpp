// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pieces/band_margin.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {
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
}  // namespace fcl_prob::detail
