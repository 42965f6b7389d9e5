// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The collision elements of a URDF as geometries.
#pragma once

#include <urdf_model/model.h>

#include <string>
#include <vector>

#include "fcl_prob/robot.h"

namespace fcl_prob::detail {

/// Those of the links that the options name. \throws FileError and as loadMesh()
std::vector<RobotBody> bodiesOf(const urdf::ModelInterface& model, const std::string& path,
                                const RobotOptions& options);

}  // namespace fcl_prob::detail
