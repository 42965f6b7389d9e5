// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Gradients for joints, as reports tell them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "fcl_prob/robot_query.h"
#include "fcl_prob/robot_scene.h"

namespace fcl_prob::cli {

/// \throws InvalidRequest unless the scene asks for waypoints with persistent errors
JointGradient jointGradient(const RobotQuery& query, const std::vector<Eigen::VectorXd>& waypoints,
                            const RobotScene& scene);

/// A row a joint, a column a waypoint.
nlohmann::ordered_json jsonOf(const JointGradient& gradient, const Robot& robot);
std::string textOf(const JointGradient& gradient, const Robot& robot);

}  // namespace fcl_prob::cli
