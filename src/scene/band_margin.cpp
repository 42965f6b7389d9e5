// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/band_margin.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "scene/widen_slabs.h"

namespace fcl_prob::detail {

double BandMargin::outwardAlong(const Eigen::Vector3d& m, NodePair nodes) const {
  const double band = outward_ * lengthOf(m);
  if (of_a_.isEmpty() && of_b_.isEmpty()) return band;
  const Eigen::Vector3d n = metres_ * m;
  return (1.0 + 1e-12) * (band + of_a_.along(n, nodes.a) + of_b_.along(n, nodes.b));
}

void BandMargin::widen(double* data, int count, NodePair leaves) const {
  widenSlabs(data, count, [&](const Eigen::Vector3d& n) {
    return SlabShift{outwardAlong(n, leaves), insideAlong(n, leaves)};
  });
}

}  // namespace fcl_prob::detail
