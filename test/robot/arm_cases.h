// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The arm that the project ships, in random states.
#pragma once

#include <algorithm>
#include <random>
#include <string>

#include "fcl_prob/robot.h"

namespace fcl_prob_test {

inline std::string shippedFile(const std::string& name) {
  return std::string(FCL_PROB_SOURCE_DIR) + "/data/" + name;
}

inline fcl_prob::Robot shippedArm(const std::vector<std::string>& links = {}) {
  fcl_prob::RobotOptions options;
  options.links = links;
  return fcl_prob::Robot(shippedFile("arm.urdf"), options);
}

/// Uniform within the limits; continuous joints within half a turn.
inline Eigen::VectorXd randomValues(const fcl_prob::Robot& robot, std::mt19937_64& random) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(robot.joints().size()));
  for (std::size_t i = 0; i < robot.joints().size(); ++i) {
    const double lower = std::max(robot.joints()[i].lower, -3.14159);
    const double upper = std::min(robot.joints()[i].upper, 3.14159);
    values[static_cast<Eigen::Index>(i)] =
        std::uniform_real_distribution<double>(lower, upper)(random);
  }
  return values;
}

}  // namespace fcl_prob_test
