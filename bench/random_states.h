// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Whole robots in any state beside a person.
#pragma once

#include <string>

#include "bench/uniforms.h"
#include "cli/geometry.h"
#include "fcl_prob/robot_query.h"

namespace fcl_prob::cli {

/// \param name  "KUKA iiwa" or "Fetch"
Robot benchRobot(const std::string& models_folder, const std::string& name);

/// A state a column: uniform within the limits; continuous joints within half a turn.
Eigen::MatrixXd drawnStates(const Robot& robot, Uniforms& random, int count);

/// 4,980 triangles.
Geometry personMesh(const std::string& models_folder);

/// Standing on the floor, 0.4 to 1 m from the robot's axis, standard deviations of 10 to 50 mm.
Obstacle personBeside(const Geometry& mesh, Uniforms& random);

}  // namespace fcl_prob::cli
