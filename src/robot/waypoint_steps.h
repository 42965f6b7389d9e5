// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The way between waypoints in steps that are short enough.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace fcl_prob::detail {

/// `fraction` of the way from waypoint `from` to the next one.
struct WaypointStep {
  std::size_t from;
  double fraction;
};

/// All waypoints and as many steps between them as interpolated() takes. \throws as that
std::vector<WaypointStep> stepsBetween(const std::vector<Eigen::VectorXd>& waypoints,
                                       double largest_step);

}  // namespace fcl_prob::detail
