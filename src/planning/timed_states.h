// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// States of a robot with their time, and how fast its joints may be.
#pragma once

#include <algorithm>

#include "fcl_prob/timed_planning.h"

namespace fcl_prob::detail {

/// States with their time as one more value, in a unit such that the largest step of a joint and
/// that of time are the same.
class TimedStates {
 public:
  /// \param end  seconds: no state is later, whatever is rounded
  /// \throws InvalidRequest for a joint that is to move without a velocity, or one given that is
  ///         none
  TimedStates(const Robot& robot, const TimedPlanningRequest& request, double end);

  Eigen::VectorXd at(double time, const Eigen::VectorXd& values) const;
  static Eigen::VectorXd valuesOf(const Eigen::VectorXd& state) {
    return state.head(state.size() - 1);
  }
  double timeOf(const Eigen::VectorXd& state) const {
    return std::min(start_time_ + state[state.size() - 1] / unit_, end_);
  }

  /// Seconds that the way from one to the other takes.
  double soonest(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const;

  /// Whether `to` is later, by what the way takes or more.
  bool isForwardInTime(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const;

 private:
  double unit_;  ///< of time, per second
  double start_time_;
  double end_;
  Eigen::VectorXd velocities_;
};

}  // namespace fcl_prob::detail
