// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/swept_path.h"

#include <algorithm>
#include <utility>

namespace fcl_prob::detail {
namespace {

// More than what the sums below are rounded by.
constexpr double kRoundedShifts = 1e-14;

/// To an obstacle that has shifted by `offset` in the middle of the step, and by `shift` less or
/// more at its ends. \param sizes  of the numbers that these were made of
void makeRelative(const Eigen::Vector3d& offset, const Eigen::Vector3d& shift, double sizes,
                  BodySweep& sweep) {
  const double size = sweep.middle.translation().norm() + sweep.motion.centre.norm() + sizes;
  sweep.middle.translation() -= offset;
  sweep.motion.centre -= offset;
  sweep.around.centre -= offset;
  const double moved = shift.norm();
  if (!(moved > 0.0)) return;
  const double rounded = kRoundedShifts * (size + moved);
  if (sweep.motion.shifts.empty()) sweep.motion.shifts.push_back(Eigen::Vector3d::Zero());
  sweep.motion.shifts[0] -= shift;
  sweep.motion.ball += rounded;
  sweep.reach += moved + rounded;
  sweep.around.radius += moved + rounded;
}

}  // namespace

SweptBody SweptPath::part(std::size_t body, std::size_t from, double first, double last,
                          double weight) const {
  JointStep step{waypoints_[from], Eigen::VectorXd::Zero(waypoints_[from].size()),
                 waypoints_[from].cwiseAbs()};
  Eigen::Vector3d offset = offsets_[from], shift = Eigen::Vector3d::Zero();
  double sizes = obstacle_size_ + offset.norm();
  if (from + 1 < waypoints_.size()) {
    const Eigen::VectorXd change = waypoints_[from + 1] - waypoints_[from];
    step.middle += 0.5 * (first + last) * change;
    step.half = 0.5 * (last - first) * change;
    step.sizes += waypoints_[from + 1].cwiseAbs();
    const Eigen::Vector3d shifted = offsets_[from + 1] - offsets_[from];
    offset += 0.5 * (first + last) * shifted;
    shift = 0.5 * (last - first) * shifted;
    sizes += offsets_[from + 1].norm();
  }
  const fcl::Transform3d pose = robot_.poses(step.middle)[body];
  BodySweep sweep = sweepOf(robot_, body, pose, balls_[body], step);
  makeRelative(offset, shift, sizes, sweep);
  return {body, from, first, last, std::move(sweep), weight, 1.0};
}

// A body that does not move from one waypoint to the next is where it was at the last one.
std::vector<SweptBody> SweptPath::wholeSteps() const {
  std::vector<SweptBody> steps;
  const std::size_t count = std::max<std::size_t>(waypoints_.size() - 1, 1);
  const double weight = 1.0 / static_cast<double>(std::max<std::size_t>(count * bodies_.size(), 1));
  for (const std::size_t body : bodies_) {
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
