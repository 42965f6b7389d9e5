// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What one plan may ask, and has asked.
#pragma once

#include <chrono>

#include "fcl_prob/motion_planning.h"

namespace fcl_prob::detail {

/// The test of states, until a limit is met or the caller cancels: then nothing is allowed any
/// more, so that a planner finds no way on.
class PlanningRun {
 public:
  PlanningRun(const StateTest& allowed, const PlanningRequest& request)
      : allowed_(allowed), request_(request) {}

  bool isAllowed(const Eigen::VectorXd& values);

  /// Whether all states of an edge are allowed, of which the first is known to be.
  bool isMotionAllowed(const Eigen::VectorXd& from, const Eigen::VectorXd& to);

  /// Looks at the clock and asks the caller. For what asks for no states for long.
  bool isStoppedNow();

  bool isStopped() const { return stopped_.has_value(); }
  std::optional<PlanningStatus> stopped() const { return stopped_; }

  std::size_t states() const { return states_; }
  void beginShortening() { shortening_ = true; }
  const PlanningRequest& request() const { return request_; }

 private:
  void lookForLimits();
  void lookAtClock();

  const StateTest& allowed_;
  const PlanningRequest& request_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::size_t states_ = 0;
  bool shortening_ = false;
  std::optional<PlanningStatus> stopped_;
};

}  // namespace fcl_prob::detail
