// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/thinned_points.h"

#include <algorithm>

namespace fcl_prob::detail {

std::vector<Eigen::Vector3d> thinnedOut(const std::vector<Eigen::Vector3d>& points,
                                        double distance) {
  std::vector<Eigen::Vector3d> kept;
  for (const Eigen::Vector3d& point : points) {
    const auto is_near = [&](const Eigen::Vector3d& other) {
      return (other - point).squaredNorm() <= distance * distance;
    };
    if (std::none_of(kept.begin(), kept.end(), is_near)) kept.push_back(point);
  }
  return kept;
}

}  // namespace fcl_prob::detail
