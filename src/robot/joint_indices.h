// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Joints of a robot by their names.
#pragma once

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot.h"

namespace fcl_prob::detail {

/// In Robot::joints(). \throws InvalidRequest for a name that is no joint that moves by itself
inline Eigen::Index jointIndex(const Robot& robot, const std::string& name) {
  const auto& joints = robot.joints();
  const auto found = std::find_if(joints.begin(), joints.end(),
                                  [&](const RobotJoint& joint) { return joint.name == name; });
  if (found != joints.end()) return found - joints.begin();
  throw InvalidRequest(robot.name() + " has no joint " + name + " that moves by itself");
}

/// In the order of the names. \throws InvalidRequest as jointIndex(), and for a name that is there
/// twice
inline std::vector<Eigen::Index> jointIndices(const Robot& robot,
                                              const std::vector<std::string>& names) {
  std::vector<Eigen::Index> indices;
  for (const std::string& name : names) {
    const Eigen::Index index = jointIndex(robot, name);
    if (std::count(indices.begin(), indices.end(), index) > 0) {
      throw InvalidRequest("the joint " + name + " is named twice");
    }
    indices.push_back(index);
  }
  return indices;
}

/// Of all joints.
inline std::vector<Eigen::Index> allJoints(const Robot& robot) {
  std::vector<Eigen::Index> all(robot.joints().size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace fcl_prob::detail
