// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/robot_notes.h"

#include "fcl_prob/exceptions.h"

namespace fcl_prob::detail {

std::vector<std::string> robotNotes(const Robot& robot) {
  std::vector<std::string> notes = robot.notes();
  std::string names;
  for (const std::string& link : robot.linksWithoutBody()) {
    names += (names.empty() ? "" : ", ") + link;
  }
  if (!names.empty()) notes.push_back("links without a body, which nothing touches: " + names);
  return notes;
}

void requireWithinLimits(const Robot& robot, const std::vector<Eigen::VectorXd>& waypoints) {
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    try {
      robot.requireWithinLimits(waypoints[i]);
    } catch (const InvalidRequest& error) {
      if (waypoints.size() == 1) throw;
      throw InvalidRequest("waypoint " + std::to_string(i) + ": " + error.what());
    }
  }
}

}  // namespace fcl_prob::detail
