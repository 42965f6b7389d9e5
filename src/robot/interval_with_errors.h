// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A certified interval for a state of a robot whose joints and base have errors of their own.
#pragma once

#include "robot/robot_among_obstacles.h"

namespace fcl_prob::detail {

/// Certainly not below P that any body touches an obstacle: by half-spaces in the space of the
/// displacement and the errors together, in which these are Gaussian, too, to first order. In a
/// millisecond. Stops when that is below `enough`, or out of reach. Parameters as below.
double upperWithErrors(const RobotAmongObstacles& among, const Eigen::VectorXd& values,
                       const Eigen::MatrixXd& covariance, const std::optional<PoseError>& base,
                       double enough);

/// That, and bands: but for a chance that is known all joints are within so many deviations, and no
/// point of a body is farther than a distance from where it is expected, so that bands so wide hold
/// for all of that, and the chance widens the interval. Its lower end is 0 unless the errors are
/// small beside the obstacles'.
/// \param among       obstacles with Gaussian displacements, which stay
/// \param covariance  of the joints, a valid one
ProbabilityResult intervalWithErrors(const RobotAmongObstacles& among,
                                     const Eigen::VectorXd& values,
                                     const Eigen::MatrixXd& covariance,
                                     const std::optional<PoseError>& base,
                                     const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
