// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Whole robots in any state beside a person.
#pragma once

#include <string>
#include <vector>

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

/// A can of 500 triangles.
Geometry canMesh(const std::string& models_folder);

/// So many, 0.3 to 0.9 m from the robot's axis and up to 1 m high, turned and displaced at random.
std::vector<Obstacle> cansAround(const Geometry& mesh, Uniforms& random, int count);

/// Milliseconds of Monte Carlo: the bodies at so many displacements of Gaussian obstacles, one
/// after the other until one is touched.
double msOfSamples(const RobotQuery& query, const std::vector<fcl::Transform3d>& poses,
                   std::uint64_t samples);

/// The bodies with padded() meshes. Shapes stay as they are: the robots here have none.
std::vector<Geometry> paddedBodies(const Robot& robot, double padding);

/// Standing on the floor, 0.4 to 1 m from the robot's axis, standard deviations of 10 to 50 mm.
Obstacle personBeside(const Geometry& mesh, Uniforms& random);

}  // namespace fcl_prob::cli
