// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A certified interval for a state of a robot whose joints and base have errors of their own.
#pragma once

#include "robot/robot_among_obstacles.h"

namespace fcl_prob::detail {

/// But for a chance that is known all joints are within so many deviations, and no point of a body
/// is farther than a distance from where it is expected: half-spaces and bands so much wider hold
/// for all of that, and the chance widens the interval. Wide, unless the errors are small beside
/// the obstacles'. \param among       obstacles with Gaussian displacements, which stay \param
/// covariance  of the joints, a valid one
ProbabilityResult intervalWithErrors(const RobotAmongObstacles& among,
                                     const Eigen::VectorXd& values,
                                     const Eigen::MatrixXd& covariance,
                                     const std::optional<PoseError>& base,
                                     const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
