// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Bodies of a robot at certain poses against one obstacle.
#pragma once

#include <functional>
#include <vector>

#include "fcl_prob/robot_query.h"
#include "robot/body_balls.h"
#include "robot/prepared_obstacle.h"
#include "robot/prepared_robot.h"

namespace fcl_prob::detail {

/// Of the tolerance: what all bodies that are left out may add up to.
inline constexpr double kShareOfFar = 0.05;

/// The same of a threshold: P that is closer to it than this share is left undecided.
inline constexpr double kFarOfDecision = 1e-12;

/// What those may add up to that are left out. \param least  P is at least that
double mostFarOf(const ProbabilityRequest& request, double least = 0.0);

/// What was left out of one query.
struct FarBodies {
  std::size_t count = 0;
  double upper = 0.0;
};

/// Leaves out the bodies that are so far from the obstacle that together they hardly matter.
/// \param balls   of the robot's bodies, in their frames
/// \param around  the obstacle, in its frame
/// \param most    what those left out may add up to
/// \return  bound on P that any of them touches it
double leaveOutFar(const std::vector<Ball>& balls, const Ball& around, const ObstacleState& state,
                   double most, std::vector<PlacedBody>& bodies);

/// What `ask` says of bodies that are near, made to hold for all of them.
/// \param far  bound on P that any of the others touches the obstacle
ProbabilityResult besidesFar(
    double far, const ProbabilityRequest& request,
    const std::function<ProbabilityResult(const ProbabilityRequest&)>& ask);

/// An obstacle and the bodies of the robot, prepared.
struct ObstacleAmongBodies {
  const PreparedRobot& robot;
  const PreparedObstacle& obstacle;
};

/// Leaves out the bodies that half-spaces show to be so unlikely to touch the obstacle that
/// together they hardly matter: fewer stay than of leaveOutFar(), in microseconds a body. \param
/// most  what those left out may add up to \return  bound on P that any of them touches it
double leaveOutUnlikely(const ObstacleAmongBodies& scene, const ObstacleState& state, double most,
                        std::vector<PlacedBody>& bodies);

/// Certainly not below P that any of the placed bodies touches the obstacle, in microseconds a
/// body: by half-spaces. 1 for errors that are not Gaussian.
double unlikelyUpper(const ObstacleAmongBodies& scene, const ObstacleState& state,
                     std::vector<PlacedBody> bodies);

/// P that any of the placed bodies touches an obstacle in some state: for a threshold by bounds on
/// bodies where these tell, else one group query, without those that are too far away to matter.
/// \throws as GroupQuery
ProbabilityResult placedProbability(const ObstacleAmongBodies& scene, const ObstacleState& state,
                                    std::vector<PlacedBody> bodies,
                                    const ProbabilityRequest& request, FarBodies& left_out);

}  // namespace fcl_prob::detail
