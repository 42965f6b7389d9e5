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

/// Of a step, by times of the waypoints: that of a waypoint as it is, and never beyond the next
/// one.
inline double timeOf(const WaypointStep& step, const std::vector<double>& times) {
  if (step.fraction == 0.0) return times[step.from];
  return (1.0 - step.fraction) * times[step.from] + step.fraction * times[step.from + 1];
}

}  // namespace fcl_prob::detail
