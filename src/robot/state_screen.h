// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Most states of a plan are told from what little is near, in microseconds.
#pragma once

#include <optional>
#include <vector>

#include "robot/body_bounds.h"
#include "robot/robot_among_obstacles.h"

namespace fcl_prob::detail {

/// Half-spaces between bodies and obstacles, whose masses are added up; and a few displaced
/// obstacles.
class StateScreen {
 public:
  /// \param among  must outlive this
  explicit StateScreen(const RobotAmongObstacles& among);

  /// Whether P is below `threshold`: certainly, or hardly; nothing: not known.
  /// \param values  valid ones
  std::optional<bool> tell(const Eigen::VectorXd& values, double threshold) const;

  /// Whether P(any body touches any obstacle) is certainly below `threshold`; false: not known.
  /// \param values  valid ones
  bool isBelow(const Eigen::VectorXd& values, double threshold) const;

 private:
  /// Bodies that are not far from an obstacle, by obstacle, and what those left out add up to.
  struct Near {
    std::vector<BodyBounds> of_obstacles;
    double far = 0.0;
  };

  bool isBelow(const Near& near, double threshold) const;

  /// Whether so many of a few displaced obstacles are touched that P is hardly below `threshold`:
  /// no proof, but where only what is below is wanted a proof of the opposite is not needed. The
  /// same displacements every time.
  bool isHardlyBelow(const Near& near, double threshold) const;

  /// \param negligible  what one that is left out may add
  Near nearOf(const Eigen::VectorXd& values, double negligible) const;
  void draw(const Obstacle& obstacle, std::uint64_t stream);

  const RobotAmongObstacles& among_;
  std::vector<GaussianDisplacement> of_bodies_;      ///< of the bodies relative to each obstacle
  std::vector<std::vector<Eigen::Vector3d>> moved_;  ///< draws of every obstacle's displacement

  /// All have bounded hulls, and all displacements are Gaussian.
  bool is_usable_ = true;
};

}  // namespace fcl_prob::detail
