// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Errors in the joints of a robot from its URDF.
#pragma once

#include <vector>

#include "fcl_prob/random_configuration.h"
#include "fcl_prob/robot.h"

namespace fcl_prob {

/// RandomJoints of a robot, whose bodies are the members of A in the order of Robot::bodies(). The
/// mean must be a state within the limits of the joints, unless RobotOptions::allow_outside_limits;
/// values that are drawn around it may be beyond them.
/// \param mean, covariance  in the order of Robot::joints(), radians and metres
/// \param poses_b           metres, world frame
/// \param displacement      of A relative to B besides, metres, world frame
/// \throws InvalidRequest as Robot::requireWithinLimits(); InvalidDistribution as RandomJoints
inline RandomJoints randomJoints(const Robot& robot, const Eigen::VectorXd& mean,
                                 const Eigen::MatrixXd& covariance,
                                 std::vector<fcl::Transform3d> poses_b,
                                 const GaussianDisplacement& displacement) {
  robot.requireWithinLimits(mean);
  const auto kinematics = [robot](const Eigen::VectorXd& values) { return robot.poses(values); };
  return {mean, covariance, kinematics, std::move(poses_b), displacement};
}

}  // namespace fcl_prob
