// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The joints that may move, as a space of OMPL's.
#pragma once

#include <ompl/base/SpaceInformation.h>
#include <ompl/geometric/PathGeometric.h>

#include <utility>
#include <vector>

#include "planning/planning_run.h"

namespace fcl_prob::detail {

/// Between which values a joint is sampled: its limits, or for a continuous one half a turn beyond
/// start and goal. \throws InvalidRequest if doubles do not tell the steps of an edge apart there
std::pair<double, double> sampledRange(const RobotJoint& joint, double start, double goal,
                                       double largest_step);

/// \throws InvalidRequest for a value beyond the limits of its joint, for a name that is no joint,
///         or one that differs between start and goal but may not move
void requireReachable(const Robot& robot, const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                      const std::vector<std::string>& joints);

class JointSpace {
 public:
  /// \param run  must live as long as information() is used
  /// \throws InvalidRequest as planMotion()
  JointSpace(const Robot& robot, const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
             PlanningRun& run);

  /// Of OMPL, with its tests of states and edges; samples depend on the seed only.
  const ompl::base::SpaceInformationPtr& information() const { return information_; }

  /// From now on samples are of another seed, and only from where paths from start to goal pass
  /// that are no longer than `longest` (Gammell, Srinivasa, Barfoot 2014), which is longer than the
  /// straight one.
  void drawWithin(double longest, std::uint64_t seed);

  /// Number of joints that move.
  std::size_t dimension() const { return indices_.size(); }

  Eigen::VectorXd valuesOf(const ompl::base::State* state) const;
  void write(const Eigen::VectorXd& values, ompl::base::State* state) const;

  std::vector<Eigen::VectorXd> waypointsOf(const ompl::geometric::PathGeometric& path) const;

 private:
  ompl::base::StateSpacePtr makeSpace(const Robot& robot) const;
  Eigen::VectorXd moving(const Eigen::VectorXd& values) const { return values(indices_); }

  const PlanningRequest& request_;
  Eigen::VectorXd start_;
  Eigen::VectorXd goal_;
  std::vector<Eigen::Index> indices_;  ///< of the joints that move
  ompl::base::SpaceInformationPtr information_;
};

}  // namespace fcl_prob::detail
