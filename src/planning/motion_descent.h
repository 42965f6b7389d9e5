// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Moving a path until P of its whole motion is below a threshold.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "fcl_prob/robot_query.h"

namespace fcl_prob::detail {

struct DescentRequest {
  double threshold = 1.0;            ///< of P that any state touches, in (0, 1]
  double largest_step = 0.05;        ///< between states, as interpolated() takes it
  std::vector<Eigen::Index> moving;  ///< the joints that may move
  std::uint64_t seed = 1;
  std::function<bool()> go_on;  ///< asked before and during every step; empty: always
};

/// The path with its inner waypoints moved such that P of the motion, errors being the same all
/// along, is below the threshold as far as an estimate tells, the squares of its edges adding up to
/// as little as can be; joints stay within their limits. By NLopt's method of moving asymptotes
/// (Svanberg 2002) and RobotQuery::gradient(). Nothing where that was not found; what is returned
/// is proven by nobody.
std::optional<std::vector<Eigen::VectorXd>> descended(const RobotQuery& query,
                                                      const std::vector<Eigen::VectorXd>& path,
                                                      const DescentRequest& request);

}  // namespace fcl_prob::detail
