// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Most states of a plan are told from what little is near, in microseconds.
#pragma once

#include <optional>
#include <vector>

#include "robot/body_bounds.h"
#include "robot/fixed_bodies.h"
#include "robot/robot_among_obstacles.h"

namespace fcl_prob::detail {

/// Half-spaces between bodies and obstacles, whose masses are added up; and balls within them. Then
/// what is known of the bodies that stay where they are.
class StateScreen {
 public:
  /// For a state. \param among  must outlive this
  explicit StateScreen(const RobotAmongObstacles& among);

  /// For many states.
  /// \param values  of the joints that stay
  /// \param moving  joints that do not
  StateScreen(const RobotAmongObstacles& among, const Eigen::VectorXd& values,
              const std::vector<Eigen::Index>& moving);

  /// Whether P(any body touches any obstacle) is below the request's threshold or above it, by what
  /// is told in microseconds and by what is known of bodies that stay: certain. Nothing: not known.
  /// \param values  valid ones
  std::optional<bool> isBelow(const Eigen::VectorXd& values,
                              const ProbabilityRequest& request) const {
    return screened(values, request).is_below;
  }

  /// The same, and where that tells nothing the obstacles are asked. \throws as RobotQuery::state()
  Decision decision(const Eigen::VectorXd& values, const ProbabilityRequest& request) const;

 private:
  /// Bodies that are not far from an obstacle, and what those left out add up to: by obstacle.
  struct Near {
    std::vector<BodyBounds> bodies;
    std::vector<double> far;
  };

  struct Screened {
    std::optional<bool> is_below;
    std::vector<Bounds> known;  ///< of P that any body touches an obstacle, by obstacle
  };

  Screened screened(const Eigen::VectorXd& values, const ProbabilityRequest& request) const;

  /// \param negligible  what one that is left out may add
  Near nearOf(const std::vector<fcl::Transform3d>& poses, double negligible) const;

  /// By obstacle. \param stay  whether bodies are where they stay
  std::vector<Bounds> knownOf(const Near& near, bool stay, const ProbabilityRequest& request) const;

  const RobotAmongObstacles& among_;
  std::optional<FixedBodies> fixed_;
  std::vector<GaussianDisplacement> of_bodies_;  ///< of the bodies relative to each obstacle

  /// All have bounded hulls, and all displacements are Gaussian.
  bool is_usable_ = true;
};

}  // namespace fcl_prob::detail
