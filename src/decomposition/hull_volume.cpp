// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "decomposition/hull_volume.h"

#include <libqhullcpp/QhullError.h>

#include "geometry/quiet_qhull.h"

namespace fcl_prob::detail {

double hullVolume(const std::vector<Eigen::Vector3d>& points) {
  if (points.size() < 4) return 0.0;
  try {
    QuietQhull qhull;
    qhull.runQhull("", 3, static_cast<int>(points.size()), points.front().data(), "Pp");
    return qhull.volume();
  } catch (const orgQhull::QhullError&) {
    return 0.0;  // flat, as far as Qhull can tell
  }
}

}  // namespace fcl_prob::detail
