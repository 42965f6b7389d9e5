// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A robot's motion past obstacles as a scene to look at.
#pragma once

#include <vector>

#include "cli/gltf_file.h"
#include "cli/motion_states.h"

namespace fcl_prob::cli {

/// The robot at the waypoints of `shown`, each coloured by its probability (what takes up the same
/// place at several of them, once, by the largest); the obstacles where they are expected, each
/// with its ellipsoids of 1, 2 and 3 sigma around the point of it that is nearest to the robot at
/// the likeliest of these waypoints (one that moves: at all of them); and, if `animated`, what of
/// the robot and the obstacles moves between the waypoints, faint. Unbounded obstacles are left
/// out.
/// \param shown  at least one
AnimatedScene motionScene(const RobotQuery& query, const std::vector<Eigen::VectorXd>& waypoints,
                          const std::vector<MotionState>& shown, bool animated);

}  // namespace fcl_prob::cli
