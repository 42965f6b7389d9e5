// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/robot_joints.h"

namespace fcl_prob {

RandomJoints randomJoints(const Robot& robot, const Eigen::VectorXd& mean,
                          const Eigen::MatrixXd& covariance, std::vector<fcl::Transform3d> poses_b,
                          const GaussianDisplacement& displacement) {
  robot.requireWithinLimits(mean);
  const auto kinematics = [robot](const Eigen::VectorXd& values) { return robot.poses(values); };
  return {mean, covariance, kinematics, std::move(poses_b), displacement};
}

}  // namespace fcl_prob
