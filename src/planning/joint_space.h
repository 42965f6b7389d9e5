// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The joints that may move, and time if it is planned in, as a space of OMPL's.
#pragma once

#include <ompl/base/SpaceInformation.h>
#include <ompl/geometric/PathGeometric.h>

#include <vector>

#include "planning/planning_run.h"

namespace fcl_prob::detail {

class JointSpace {
 public:
  /// \param run  must live as long as information() is used
  /// \throws InvalidRequest as planMotion()
  JointSpace(const Robot& robot, const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
             PlanningRun& run)
      : JointSpace(robot, start, goal, run, false) {}

  /// States have one more value behind those of the joints, which is between those of start and
  /// goal.
  static JointSpace withTime(const Robot& robot, const Eigen::VectorXd& start,
                             const Eigen::VectorXd& goal, PlanningRun& run) {
    return {robot, start, goal, run, true};
  }

  JointSpace(const JointSpace&) = delete;
  JointSpace& operator=(const JointSpace&) = delete;

  /// Of OMPL, with its tests of states and edges; samples depend on the seed only.
  const ompl::base::SpaceInformationPtr& information() const { return information_; }

  /// Number of joints that move, and of time.
  std::size_t dimension() const { return indices_.size(); }

  Eigen::VectorXd valuesOf(const ompl::base::State* state) const;
  void write(const Eigen::VectorXd& values, ompl::base::State* state) const;

  std::vector<Eigen::VectorXd> waypointsOf(const ompl::geometric::PathGeometric& path) const;

 private:
  JointSpace(const Robot& robot, const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
             PlanningRun& run, bool has_time);
  void chooseJoints(const Robot& robot, const Eigen::VectorXd& goal);
  ompl::base::StateSpacePtr makeSpace(const Robot& robot, const Eigen::VectorXd& goal) const;

  const PlanningRequest& request_;
  Eigen::VectorXd start_;
  std::vector<Eigen::Index> indices_;  ///< of the values that change
  ompl::base::SpaceInformationPtr information_;
};

}  // namespace fcl_prob::detail
