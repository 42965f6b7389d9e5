// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <algorithm>

#include "fcl_prob/robot_query.h"

namespace fcl_prob {

// The obstacle's frame is that of its first body.
Obstacle obstacleOf(const std::string& name, const Robot& robot, const Eigen::VectorXd& values,
                    Displacement displacement) {
  const std::vector<fcl::Transform3d> poses = robot.poses(values);
  Obstacle obstacle;
  obstacle.name = name;
  obstacle.displacement = std::move(displacement);
  obstacle.notes = robot.notes();
  obstacle.geometry = robot.bodies()[0].geometry;
  obstacle.pose = poses[0];
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const RobotBody& body = robot.bodies()[i];
    obstacle.coordinate_error = std::max(obstacle.coordinate_error, body.coordinate_error);
    if (i > 0) obstacle.more.push_back({body.geometry, poses[0].inverse() * poses[i]});
  }
  return obstacle;
}

}  // namespace fcl_prob
