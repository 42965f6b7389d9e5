// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// P that a motion touches one obstacle whose error is the same all along.
#pragma once

#include <vector>

#include "base/budget.h"
#include "robot/robot_among_obstacles.h"
#include "robot/swept_motion.h"

namespace fcl_prob::detail {

class ObstacleMotion {
 public:
  /// Keeps references.
  /// \param body    the only one that counts, or -1
  /// \param placed  the bodies at the waypoints: see RobotAmongObstacles::relativeTo()
  ObstacleMotion(const RobotAmongObstacles& among, std::size_t obstacle,
                 const std::vector<Eigen::VectorXd>& waypoints, int body,
                 const std::vector<PlacedBody>& placed)
      : among_(among), obstacle_(obstacle), waypoints_(waypoints), body_(body), placed_(placed) {}

  /// At one of the waypoints. Of many bodies those that hardly matter beside the rest are left out;
  /// the others are taken together, or, for a decision and where memory does not allow that, as
  /// what they sweep over many waypoints.
  ProbabilityResult atWaypoints(const ProbabilityRequest& request, FarBodies& left_out) const;

  /// The same to a tolerance that takes a small share of what the budget has left: P at any time is
  /// at least what it says at least.
  ProbabilityResult soonAtWaypoints(const Budget& budget, const ProbabilityRequest& request) const;

  /// At any time between them, too. \param known  what is certain before
  SweptAnswer atAllTimes(const Bounds& known, const ProbabilityRequest& request) const;

 private:
  ProbabilityResult atSome(const Budget& budget, const ProbabilityRequest& request) const;
  std::size_t memoryOf(const std::vector<PlacedBody>& bodies) const;
  ProbabilityResult ofMany(const ProbabilityRequest& request, double least,
                           FarBodies& left_out) const;
  ProbabilityResult sweptWaypoints(const Bounds& known, const ProbabilityRequest& request,
                                   FarBodies& left_out) const;
  SweptAnswer swept(BetweenWaypoints between, const Bounds& known,
                    const ProbabilityRequest& request) const;

  const RobotAmongObstacles& among_;
  std::size_t obstacle_;
  const std::vector<Eigen::VectorXd>& waypoints_;
  int body_;
  const std::vector<PlacedBody>& placed_;
};

}  // namespace fcl_prob::detail
