// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How the probability to touch one obstacle changes with the joints that carry the bodies.
#pragma once

#include <vector>

#include "fcl_prob/joint_gradient.h"
#include "robot/placed_query.h"

namespace fcl_prob::detail {

/// A body of a robot at a waypoint.
struct WaypointBody {
  std::size_t waypoint;
  std::size_t body;
  fcl::Transform3d pose;    ///< relative to where the obstacle is by then
  Eigen::Vector3d shifted;  ///< from the body's pose in the world to that one
};

/// With the joints at waypoint k as parameters k n to k n + n - 1, n the number of joints.
/// \throws InvalidRequest for a truncated displacement
MotionGradient obstacleGradient(const Robot& robot, const std::vector<Eigen::VectorXd>& waypoints,
                                const std::vector<WaypointBody>& bodies,
                                const ObstacleAmongBodies& scene, const ObstacleState& state,
                                const MotionGradientRequest& request);

/// Of obstacles whose errors are independent.
JointGradient anyOfGradients(const std::vector<MotionGradient>& parts, Eigen::Index joints,
                             Eigen::Index waypoints);

}  // namespace fcl_prob::detail
