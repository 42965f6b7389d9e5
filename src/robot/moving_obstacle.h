// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Obstacles that are elsewhere, or less certain, at every waypoint.
#pragma once

#include <string>
#include <vector>

#include "fcl_prob/robot_query.h"
#include "robot/waypoint_steps.h"

namespace fcl_prob::detail {

/// The obstacle as it is at a waypoint.
ObstacleState stateAt(const Obstacle& obstacle, std::size_t waypoint);

/// Whether the states of an obstacle have times.
bool isPredicted(const std::vector<ObstacleState>& over_time);

/// The obstacle where it is in one of its states, as one that stays.
Obstacle standing(Obstacle obstacle, const ObstacleState& state);

/// \throws InvalidRequest unless all of its states have times, each later than the one before, or
///         none has
void requireTimes(const Obstacle& obstacle);

/// \throws InvalidRequest unless it is predicted for that time; as statesAt()
ObstacleState predictedAt(const Obstacle& obstacle, double time);

/// \throws InvalidRequest unless it stays or has one state a waypoint
void requireStates(const Obstacle& obstacle, std::size_t waypoints);

/// \param what  is only for those that stay, as "plans are"
/// \throws InvalidRequest naming the first that moves
void requireStaying(const std::vector<Obstacle>& obstacles, const std::string& what);

/// How far the obstacle has moved since the first of so many waypoints, its mean displacement
/// included: with that, an error that is the same all along is one displacement of one obstacle.
/// \throws InvalidRequest if it turns on the way or its covariance changes: there is then no such
///         error
std::vector<Eigen::Vector3d> offsetsSinceFirst(const Obstacle& obstacle, std::size_t waypoints);

/// How far from the origin it is at most, its mean displacement included; 0 if it does not move.
double largestPosition(const Obstacle& obstacle);

/// States at steps between the given ones: positions, means and covariances linear in between,
/// orientations along the shortest turn. Empty for an obstacle that stays.
/// \throws InvalidRequest for displacements that are not Gaussian
std::vector<ObstacleState> statesAt(const std::vector<ObstacleState>& given,
                                    const std::vector<WaypointStep>& steps);

}  // namespace fcl_prob::detail
