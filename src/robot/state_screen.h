// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Most states of a plan are told from what little is near, in microseconds.
#pragma once

#include <optional>
#include <vector>

#include "robot/body_bounds.h"
#include "robot/robot_among_obstacles.h"

namespace fcl_prob::detail {

/// Half-spaces between bodies and obstacles, whose masses are added up; and balls within them.
class StateScreen {
 public:
  /// \param among  must outlive this
  explicit StateScreen(const RobotAmongObstacles& among);

  /// Whether P(any body touches any obstacle) is below `threshold` or above it: certain. Nothing:
  /// not known. \param values  valid ones
  std::optional<bool> isBelow(const Eigen::VectorXd& values, double threshold,
                              ContactMeaning contact) const;

 private:
  /// Bodies that are not far from an obstacle, by obstacle, and what those left out add up to.
  struct Near {
    std::vector<BodyBounds> of_obstacles;
    double far = 0.0;
  };

  /// \param negligible  what one that is left out may add
  Near nearOf(const Eigen::VectorXd& values, double negligible) const;

  const RobotAmongObstacles& among_;
  std::vector<GaussianDisplacement> of_bodies_;  ///< of the bodies relative to each obstacle

  /// All have bounded hulls, and all displacements are Gaussian.
  bool is_usable_ = true;
};

}  // namespace fcl_prob::detail
