// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Which joints of a robot a plan may move.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot.h"

namespace fcl_prob::detail {

/// Indices of those that are named, of all if none is, but for those whose limits leave no room.
inline std::vector<Eigen::Index> movingJoints(const Robot& robot,
                                              const std::vector<std::string>& names) {
  std::vector<Eigen::Index> moving;
  for (std::size_t i = 0; i < robot.joints().size(); ++i) {
    const RobotJoint& joint = robot.joints()[i];
    const bool is_named =
        names.empty() || std::find(names.begin(), names.end(), joint.name) != names.end();
    if (is_named && joint.lower < joint.upper) moving.push_back(static_cast<Eigen::Index>(i));
  }
  return moving;
}

/// \throws InvalidRequest unless the robot that may touch itself has the joints of the query's
inline void requireSameJoints(const Robot& self, const Robot& robot) {
  const auto is_same = [](const RobotJoint& x, const RobotJoint& y) { return x.name == y.name; };
  const auto &x = self.joints(), &y = robot.joints();
  if (std::equal(x.begin(), x.end(), y.begin(), y.end(), is_same)) return;
  throw InvalidRequest("self-collision is of a robot with other joints than the query's");
}

}  // namespace fcl_prob::detail
