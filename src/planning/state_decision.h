// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Whether a state of a plan is certainly below its threshold, and what its P is.
#pragma once

#include <algorithm>

#include "base/stopwatch.h"
#include "fcl_prob/motion_planning.h"
#include "fcl_prob/robot_query.h"
#include "robot/interval_with_errors.h"
#include "robot/state_screen.h"
#include "robot/state_with_errors.h"

namespace fcl_prob::detail {

/// One query, which must outlive it, and errors of its robot.
class StateDecision {
 public:
  /// \param stays  what StateScreen has to know for many states; none for a single one
  /// \throws as RobotQuery::state() for the errors
  template <typename... Stays>
  StateDecision(const RobotQuery& query, const RobotErrors& errors, const Stays&... stays)
      : query_(query), errors_(errors), screen_(query.among(), stays...), single_(query.among()) {
    if (!errors.none()) covariance_ = validCovariance(query.among(), errors);
  }

  /// \param request  with a threshold
  bool isBelow(const Eigen::VectorXd& values, const ProbabilityRequest& request) const {
    if (!errors_.none()) return upper(values, *request.threshold) < *request.threshold;
    return screen_.decision(values, request) == Decision::below;
  }

  /// Of P that anything is touched; nothing where that is certainly below `least`.
  std::optional<Bounds> above(const Eigen::VectorXd& values, double least,
                              ProbabilityRequest request) const {
    if (!errors_.none()) return Bounds{0.0, upper(values, least)};
    request.threshold = least;
    if (single_.isBelow(values, request) == true) return std::nullopt;
    request.threshold.reset();
    return query_.state(values, request).any;
  }

 private:
  double upper(const Eigen::VectorXd& values, double enough) const {
    return upperWithErrors(query_.among(), values, covariance_, errors_.base, enough);
  }

  const RobotQuery& query_;
  const RobotErrors& errors_;
  Eigen::MatrixXd covariance_;  ///< of the joints, with errors
  StateScreen screen_;
  StateScreen single_;  ///< for other thresholds
};

/// What is left of a plan's time, if that has a limit: > 0, as a limit must be. One that has passed
/// ends a plan at its first state.
inline std::optional<double> secondsLeft(const PlanningRequest& plan, const Stopwatch& watch) {
  if (!plan.time_limit) return std::nullopt;
  return std::max(1e-9, *plan.time_limit - watch.seconds());
}

/// A request that gives what it has where the plan's time ends.
inline ProbabilityRequest withinTime(ProbabilityRequest request, const PlanningRequest& plan,
                                     const Stopwatch& watch) {
  const auto left = secondsLeft(plan, watch);
  if (left) request.time_limit = std::min(request.time_limit.value_or(*left), *left);
  return request;
}

/// The largest P of several, as it becomes known.
struct LargestOfStates {
  Bounds probability{0.0, 0.0};

  /// Whether this one is the likeliest by now, by its upper bound.
  bool add(const std::optional<Bounds>& one) {
    if (!one) return false;
    probability.lower = std::max(probability.lower, one->lower);
    if (one->upper <= probability.upper) return false;
    probability.upper = one->upper;
    return true;
  }
};

}  // namespace fcl_prob::detail
