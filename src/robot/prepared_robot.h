// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What queries keep of a robot's bodies, whatever their state and whatever is around them.
#pragma once

#include <vector>

#include "fcl_prob/robot.h"
#include "robot/body_balls.h"
#include "robot/node_hulls.h"

namespace fcl_prob::detail {

/// Kept by the robot, and shared by its queries. Const calls are safe on several threads.
struct PreparedRobot {
  /// \throws InvalidGeometry, UnsupportedGeometry
  /// \param before  of the first of them: what it prepared is shared; null: nothing is
  explicit PreparedRobot(const std::vector<RobotBody>& bodies,
                         const PreparedRobot* before = nullptr);

  PreparedGeometries geometries;  ///< of the bodies
  std::vector<Ball> balls;        ///< in their frames
  HullsOfBodies hulls;
};

/// A body of the robot at one of the waypoints.
struct PlacedBody {
  std::size_t body;
  fcl::Transform3d pose;  ///< metres, world frame
};

}  // namespace fcl_prob::detail
