// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Poses and vectors of a URDF, which may be anything.
#pragma once

#include <fcl/common/types.h>
#include <urdf_model/pose.h>

#include <string>

namespace fcl_prob::detail {

/// \param where  begins the message, as "arm.urdf: link hand: collision 0"
/// \throws FileError if a number is not finite
Eigen::Vector3d vectorOf(const urdf::Vector3& vector, const std::string& where);
fcl::Transform3d poseOf(const urdf::Pose& pose, const std::string& where);

/// \throws FileError if it is not finite and > 0
double positive(double size, const std::string& where);

}  // namespace fcl_prob::detail
