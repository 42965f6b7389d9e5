// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "planning/planning_run.h"

#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot_query.h"

namespace fcl_prob::detail {
namespace {

/// States between two looks at the clock and two calls of on_progress.
constexpr std::size_t kStatesPerLook = 16;

void validateRequest(const PlanningRequest& request) {
  if (!(request.largest_step > 0.0)) {
    throw InvalidRequest("the largest step must be > 0, is " + numberText(request.largest_step));
  }
  if (request.max_states == 0) throw InvalidRequest("max_states must be at least 1");
  if (request.time_limit && !(*request.time_limit > 0.0)) {
    throw InvalidRequest("the time limit must be > 0, is " + numberText(*request.time_limit));
  }
}

}  // namespace

PlanningRun::PlanningRun(StateTest allowed, const PlanningRequest& request, EdgeRule rule)
    : allowed_(std::move(allowed)), request_(request), rule_(std::move(rule)) {
  validateRequest(request);
}

bool PlanningRun::isAllowed(const Eigen::VectorXd& values) {
  lookForLimits();
  if (stopped_ || hasNoStatesLeft()) return false;
  ++states_;
  return allowed_(values);
}

void PlanningRun::lookForLimits() {
  if (stopped_) return;
  if (states_ >= request_.max_states) {
    stopped_ = PlanningStatus::state_limit;
    return;
  }
  if (states_ % kStatesPerLook == 0) lookAtClock();
}

bool PlanningRun::isStoppedNow() {
  if (!stopped_) lookAtClock();
  return isStopped();
}

void PlanningRun::lookAtClock() {
  const double passed = seconds();
  if (request_.time_limit && passed >= *request_.time_limit) {
    stopped_ = PlanningStatus::time_limit;
  } else if (request_.on_progress && !request_.on_progress({states_, passed, shortening_})) {
    stopped_ = PlanningStatus::cancelled;
  }
}

// The far end and the middle first: where an edge is not allowed, states near its beginning, which
// is allowed, are the last to tell.
bool PlanningRun::isMotionAllowed(const Eigen::VectorXd& from, const Eigen::VectorXd& to) {
  if (rule_ && !rule_(from, to)) return false;
  const std::vector<Eigen::VectorXd> states = interpolated({from, to}, request_.largest_step);
  const std::size_t last = states.size() - 1;
  if (!isAllowed(states[last])) return false;
  std::size_t stride = 1;
  while (2 * stride < last) stride *= 2;
  for (; stride >= 1; stride /= 2) {
    for (std::size_t i = stride; i < last; i += 2 * stride) {
      if (!isAllowed(states[i])) return false;
    }
  }
  return true;
}

}  // namespace fcl_prob::detail
