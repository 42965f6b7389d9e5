// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/swept_path.h"

#include <algorithm>

namespace fcl_prob::detail {

SweptBody SweptPath::part(std::size_t body, std::size_t from, double first, double last,
                          double weight) const {
  JointStep step{waypoints_[from], Eigen::VectorXd::Zero(waypoints_[from].size())};
  if (from + 1 < waypoints_.size()) {
    const Eigen::VectorXd change = waypoints_[from + 1] - waypoints_[from];
    step.middle += 0.5 * (first + last) * change;
    step.half = 0.5 * (last - first) * change;
  }
  const fcl::Transform3d pose = robot_.poses(step.middle)[body];
  return {body, from, first, last, sweepOf(robot_, body, pose, balls_[body], step), weight, 1.0};
}

// A body that does not move from one waypoint to the next is where it was at the last one.
std::vector<SweptBody> SweptPath::wholeSteps() const {
  std::vector<SweptBody> steps;
  const std::size_t count = std::max<std::size_t>(waypoints_.size() - 1, 1);
  const std::size_t bodies = robot_.bodies().size();
  const double weight = 1.0 / static_cast<double>(count * bodies);
  for (std::size_t body = 0; body < bodies; ++body) {
    for (std::size_t from = 0; from < count; ++from) {
      SweptBody step = part(body, from, 0.0, 1.0, weight);
      if (from == 0 || step.sweep.reach > 0.0) steps.push_back(std::move(step));
    }
  }
  return steps;
}

std::vector<SweptBody> SweptPath::halvesOf(const SweptBody& step) const {
  const double middle = 0.5 * (step.first + step.last);
  const double weight = 0.5 * step.weight;
  return {part(step.body, step.from, step.first, middle, weight),
          part(step.body, step.from, middle, step.last, weight)};
}

}  // namespace fcl_prob::detail
