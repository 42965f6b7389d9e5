// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The two scenes of the paper's Table II, as far as it tells them, for a Fetch arm.
#pragma once

#include <string>
#include <vector>

#include "fcl_prob/robot_query.h"
#include "fcl_prob/self_collision.h"

namespace fcl_prob::cli {

struct Table2Scene {
  std::string name;
  RobotQuery query;    ///< arm, gripper and what it holds among the obstacles
  SelfCollision self;  ///< all of the robot
  Eigen::VectorXd start;
  Eigen::VectorXd goal;
  std::vector<std::string> joints;  ///< that move
};

/// "cans": the arm carries a can over a table with two more and past a human arm. "waving": the
/// arm goes past a human arm that waves, predicted at four times with a covariance that grows; as
/// four obstacles, since each of them may be there when the robot comes.
/// \param models_folder  holds fetch_robot/, human/ and objects/
std::vector<Table2Scene> table2Scenes(const std::string& models_folder);

/// The poses of the arm that waves one at a time, each with its covariance.
std::vector<Table2Scene> singleArmScenes(const std::string& models_folder);

}  // namespace fcl_prob::cli
