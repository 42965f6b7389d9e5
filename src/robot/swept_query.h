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

/// P(any of the bodies touches the obstacle at any time of its step). `upper` is that of all times,
/// `lower` that of the middles of the steps. Tolerance, threshold and limits as in every query;
/// status `band_limit` where the steps are too long for the tolerance.
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
