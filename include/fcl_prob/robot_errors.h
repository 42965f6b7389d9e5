// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Errors of a robot itself: of its joints and of where its base is.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>

#include "fcl_prob/pose_error.h"
#include "fcl_prob/robot.h"

namespace fcl_prob {

/// Gaussian, independent of each other and of the obstacles' displacements.
struct RobotErrors {
  /// Covariance of the joint values (radians, metres), in the order of Robot::joints(), of any
  /// rank; 0 x 0: they are exact.
  Eigen::MatrixXd joints = {};

  /// Of the pose of the root link; none: it is exact.
  std::optional<PoseError> base = std::nullopt;

  bool none() const { return joints.size() == 0 && !base; }
};

/// Independent errors of joints. \param deviations  standard deviations by name, radians or metres;
/// joints that are not named are exact
/// \throws InvalidRequest for a name that is no joint; InvalidDistribution for a deviation that is
///         negative or not finite
Eigen::MatrixXd jointCovariance(const Robot& robot,
                                const std::map<std::string, double>& deviations);

}  // namespace fcl_prob
