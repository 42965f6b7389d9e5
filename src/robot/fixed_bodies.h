// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Bodies that stay where they are from state to state: a base, a torso.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <tuple>
#include <vector>

#include "robot/robot_among_obstacles.h"

namespace fcl_prob::detail {

/// The bodies that no moving joint carries. What they have to do with the obstacles is found once,
/// when a state first asks, and is the same for all.
class FixedBodies {
 public:
  /// \param among   must outlive this
  /// \param values  of the joints that stay
  /// \param moving  joints
  FixedBodies(const RobotAmongObstacles& among, const Eigen::VectorXd& values,
              const std::vector<Eigen::Index>& moving);

  /// Whether they are where the poses of all bodies have them; false if there are none.
  bool areAmong(const std::vector<fcl::Transform3d>& poses) const;

  bool contains(std::size_t body) const { return is_fixed_[body]; }

  /// Certified bounds on P that any of them touches an obstacle, by obstacle. Nothing where the
  /// clock or the caller ended the search.
  /// \param request  with a threshold, which says how closely; its limits are those of the search
  std::optional<std::vector<Bounds>> bounds(const ProbabilityRequest& request) const;

 private:
  using Question = std::tuple<double, ContactMeaning, std::size_t>;  ///< threshold, contact, cells

  const RobotAmongObstacles& among_;
  std::vector<fcl::Transform3d> poses_;  ///< of all bodies
  std::vector<bool> is_fixed_;
  mutable std::mutex mutex_;
  mutable std::map<Question, std::vector<Bounds>> known_;
};

}  // namespace fcl_prob::detail
