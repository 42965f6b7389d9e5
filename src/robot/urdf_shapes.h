// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The collision elements of a URDF as geometries.
#pragma once

#include <vector>

#include "fcl_prob/robot.h"
#include "robot/urdf_model.h"

namespace fcl_prob::detail {

/// Those of the links that the options name; notes of their meshes become the model's. \throws
/// FileError and as loadMesh(), beginning with the place in the URDF
std::vector<RobotBody> bodiesOf(UrdfModel& model, const UrdfSource& source,
                                const RobotOptions& options);

}  // namespace fcl_prob::detail
