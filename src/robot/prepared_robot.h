// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What queries keep of a robot, whatever its state and whatever is around it.
#pragma once

#include <vector>

#include "fcl_prob/robot.h"
#include "robot/body_balls.h"
#include "robot/node_hulls.h"

namespace fcl_prob::detail {

struct PreparedRobot {
  /// \throws InvalidGeometry, UnsupportedGeometry
  explicit PreparedRobot(const Robot& of);

  Robot robot;
  PreparedGeometries geometries;  ///< of its bodies
  std::vector<Ball> balls;        ///< in the frames of the bodies
  HullsOfBodies hulls;
};

/// A body of the robot at one of the waypoints.
struct PlacedBody {
  std::size_t body;
  fcl::Transform3d pose;  ///< metres, world frame
};

}  // namespace fcl_prob::detail
