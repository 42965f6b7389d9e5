// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What was asked of a robot, such that strangers can ask it again.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "fcl_prob/robot_scene.h"

namespace fcl_prob::cli {

/// Writes a folder that needs no other file: scene.json, with the request as it was asked and the
/// answer in its description, the meshes of obstacles in it as numbers; the URDFs and the SRDF as
/// they are but for the names of meshes, which are beside them with all digits.
/// \param file  that `scene` was read from
/// \throws FileError if a scene.json is there already, or a URDF writes the name of a mesh so that
///         it is not found in its text
void writeRobotReproduction(const RobotScene& scene, const std::string& file,
                            const nlohmann::ordered_json& answer, const std::string& folder);

}  // namespace fcl_prob::cli
