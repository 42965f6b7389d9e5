// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Swept bodies against one obstacle: one partition for all of them.
#pragma once

#include <vector>

#include "fcl_prob/robot_query.h"
#include "robot/prepared_obstacle.h"
#include "robot/swept_path.h"

namespace fcl_prob::detail {

/// An obstacle as its perception places it.
struct PlacedObstacle {
  const PreparedObstacle& prepared;
  const fcl::Transform3d& pose;
  const Displacement& displacement;  ///< of the obstacle
};

/// What bounds P(any of the bodies touches the obstacle at any time of its step) from above: the
/// lower end is that of all that steps may fill, and of P only where none has a reach. Tolerance,
/// threshold and limits as in every query.
/// \param bodies      those of one index in the order of time
/// \param geometries  of the robot's bodies
/// \throws UnsupportedGeometry, OpenMesh
ProbabilityResult sweptProbability(const std::vector<SweptBody>& bodies,
                                   const PreparedGeometries& geometries,
                                   const PlacedObstacle& obstacle,
                                   const ProbabilityRequest& request);

/// Bytes that one body more takes before the first cell, roughly; and what all may take.
std::size_t treeMemory(const PreparedGeometry& body);
std::size_t mostTreeMemory(const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
