// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What one plan may ask, and has asked.
#pragma once

#include <algorithm>
#include <chrono>
#include <limits>

#include "fcl_prob/motion_planning.h"

namespace fcl_prob::detail {

/// How far the trees of RRT-Connect grow at once, in joint space (and the unit of time). An edge is
/// taken whole or not at all: long ones are refused more often.
inline constexpr double kTreeRange = 0.5;

/// A number of states that is no limit.
inline constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

/// Whether an edge may be at all, whatever its states are.
using EdgeRule = std::function<bool(const Eigen::VectorXd& from, const Eigen::VectorXd& to)>;

/// The test of states, until a limit is met or the caller cancels: then nothing is allowed any
/// more, so that a planner finds no way on.
class PlanningRun {
 public:
  /// \param rule  for edges; empty: every edge may be
  /// \throws InvalidRequest for a step or a limit that is not > 0
  PlanningRun(StateTest allowed, const PlanningRequest& request, EdgeRule rule = {});

  bool isAllowed(const Eigen::VectorXd& values);

  /// Whether all states of an edge are allowed, of which the first is known to be.
  bool isMotionAllowed(const Eigen::VectorXd& from, const Eigen::VectorXd& to);

  /// Looks at the clock and asks the caller. For what asks for no states for long.
  bool isStoppedNow();

  /// No more than `most` further states are allowed, until this is called anew.
  void limitStates(std::size_t most) { last_state_ = states_ + std::min(most, kAll - states_); }
  bool hasNoStatesLeft() const { return states_ >= last_state_; }

  bool isStopped() const { return stopped_.has_value(); }
  std::optional<PlanningStatus> stopped() const { return stopped_; }

  std::size_t states() const { return states_; }
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  void beginShortening() { shortening_ = true; }
  const PlanningRequest& request() const { return request_; }

 private:
  void lookForLimits();
  void lookAtClock();

  const StateTest allowed_;
  const PlanningRequest& request_;
  const EdgeRule rule_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::size_t states_ = 0;
  std::size_t last_state_ = kAll;
  bool shortening_ = false;
  std::optional<PlanningStatus> stopped_;
};

}  // namespace fcl_prob::detail
