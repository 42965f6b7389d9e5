// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The joints of a robot that an SRDF names together, and states of them. In the library
// fcl_prob::robot.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fcl_prob/robot.h"

namespace fcl_prob {

struct RobotGroup {
  /// Those that move by themselves, in the order of Robot::joints(): what a plan of the group moves
  /// (PlanningRequest::joints).
  std::vector<std::string> joints;

  /// Links that hang on a joint of the group, fixed and mimic joints included, in the order of
  /// Robot::links().
  std::vector<std::string> links;

  /// Of each `group_state` the values of `joints` that it names, radians or metres, as
  /// Robot::values() takes them. Limits are not looked at.
  std::map<std::string, std::map<std::string, double>> states;
};

using RobotGroups = std::map<std::string, RobotGroup>;

/// Reads the groups of an SRDF and their states by name. As for MoveIt, a group has the joints that
/// it names, the joints on which its links hang, those between the two links of a chain, and those
/// of its groups. Passed over are the file's virtual joints, which move the root link, and what a
/// state says of joints that do not move by themselves. The file is trusted no more than a URDF.
/// \throws FileError naming the file, the line and the element: as loadAllowedPairs(); a joint,
///         link or group that is not there, a name that is there twice, groups nested deeper than
///         64 or in each other, a value that is no finite number, a joint of a state that is not
///         one of its group, an element that is not known
RobotGroups loadGroups(const std::string& srdf_file, const Robot& robot);

}  // namespace fcl_prob
