// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Rotations and their exponential coordinates.
#pragma once

#include <Eigen/Core>
#include <string>

namespace fcl_prob::detail {

/// \throws InvalidPose if `rotation` is not a rotation to 1e-9.
void requireRotation(const Eigen::Matrix3d& rotation);

/// Rz(yaw) Ry(pitch) Rx(roll), radians: turns about fixed axes in URDF's order.
/// \throws InvalidPose that begins with `name` if an angle is not finite, or is more than a turn,
/// as
///         degrees would be.
Eigen::Matrix3d rotationOfAngles(const Eigen::Vector3d& roll_pitch_yaw, const std::string& name);

/// [v]×, the matrix of the cross product with v.
Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v);

/// V(θ) = 1 + (1 - cos|θ|)/|θ|² [θ]× + (|θ| - sin|θ|)/|θ|³ [θ]×²: what the translation of an
/// element of the Lie algebra of SE(3) becomes in the group.
Eigen::Matrix3d translationJacobian(const Eigen::Vector3d& rotation_vector);

}  // namespace fcl_prob::detail
