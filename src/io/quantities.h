// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Poses and covariances as the lists of numbers in which files and command lines give them.
#pragma once

#include <fcl/common/types.h>

#include <optional>
#include <string>
#include <vector>

#include "fcl_prob/pose_error.h"
#include "fcl_prob/probability_request.h"

namespace fcl_prob::detail {

using Numbers = std::vector<double>;

/// Numbers with commas between them. \throws InvalidRequest naming what is none
Numbers numberList(const std::string& text);

/// x, y, z in metres, alone or with qw, qx, qy, qz, which is normalised, or roll, pitch, yaw in
/// radians, turns about fixed axes; or twelve, the rows of [R | t], taken as they are. \throws
/// InvalidPose if there are not 3, 6, 7 or 12 finite numbers, the quaternion is zero, or an angle
/// is more than a turn.
fcl::Transform3d poseFrom(const Numbers& numbers);

/// qw, qx, qy, qz, normalised. \throws InvalidPose
Eigen::Quaterniond quaternionFrom(const Numbers& numbers);

/// Three numbers. \throws InvalidRequest that begins with `name`.
Eigen::Vector3d vectorFrom(const Numbers& numbers, const std::string& name);

/// xx, xy, xz, yy, yz, zz. \throws InvalidDistribution if there are not six numbers.
Eigen::Matrix3d covarianceFrom(const Numbers& numbers);

/// Six standard deviations or means x, y, z, rx, ry, rz. \throws InvalidRequest that begins with
/// `name`.
PoseError::Vector6 sixFrom(const Numbers& numbers, const std::string& name);

/// A 6 x 6 covariance row by row: all of it, as ROS has it, or its upper triangle.
/// \throws InvalidDistribution if there are neither 36 nor 21 numbers.
PoseError::Matrix6 poseCovarianceFrom(const Numbers& numbers);

/// Independent standard deviations x, y, z, rx, ry, rz around a mean. \throws InvalidDistribution
PoseError poseErrorFrom(const PoseError::Vector6& sigma, PoseConvention convention,
                        const PoseError::Vector6& mean);

/// "world", "body", "world-exponential" and "body-exponential".
std::optional<PoseConvention> poseConventionFromString(const std::string& name);
std::string toString(PoseConvention convention);

/// A distance, or one outwards and one inwards. \throws InvalidRequest if there are not so many, or
/// one is negative or not finite.
Band bandFrom(const Numbers& numbers);

/// "fcl", "solid" and "contained".
std::optional<ContactMeaning> contactFromString(const std::string& name);
std::string toString(ContactMeaning contact);

}  // namespace fcl_prob::detail
