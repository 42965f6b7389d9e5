// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/swept_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fcl_prob::detail {
namespace {

// More than what the sums below are rounded by.
constexpr double kRoundedShifts = 1e-14;

/// A half that reaches this part of its step, or more, does so by rounding.
constexpr double kMostOfHalf = 0.8;

/// Where the obstacle is while a body moves, since the first waypoint.
struct ObstacleShift {
  Eigen::Vector3d middle;
  Eigen::Vector3d half;  ///< along the line of the step
  double off = 0.0;      ///< farther off it than this it is never
  double sizes = 0.0;    ///< of the numbers that these were made of
};

void makeRelative(const ObstacleShift& obstacle, BodySweep& sweep) {
  const double size =
      sweep.middle.translation().norm() + sweep.motion.centre.norm() + obstacle.sizes;
  sweep.middle.translation() -= obstacle.middle;
  sweep.motion.centre -= obstacle.middle;
  sweep.around.centre -= obstacle.middle;
  const double moved = obstacle.half.norm() + obstacle.off;
  if (!(moved > 0.0)) return;
  const double rounded = kRoundedShifts * (size + moved);
  if (sweep.motion.shifts.empty()) sweep.motion.shifts.push_back(Eigen::Vector3d::Zero());
  sweep.motion.shifts[0] -= obstacle.half;
  sweep.motion.ball += obstacle.off + rounded;
  sweep.reach += moved + rounded;
  sweep.around.radius += moved + rounded;
}

/// Whole numbers, for the times of waypoints.
std::size_t waypointAt(double time) { return static_cast<std::size_t>(time); }

/// Between waypoints, rounded down.
double middleOf(double first, double last) { return std::floor(0.5 * (first + last)); }

}  // namespace

SweptBody SweptPath::part(std::size_t body, double first, double last, double weight) const {
  const bool waypoints = between_ == BetweenWaypoints::ignored || last - first > 1.0;
  SweptBody step =
      waypoints ? across(body, waypointAt(first), waypointAt(last)) : between(body, first, last);
  step.weight = weight;
  return step;
}

/// Within one way from a waypoint to the next.
SweptBody SweptPath::between(std::size_t body, double first, double last) const {
  const std::size_t from = std::min(waypointAt(first), waypoints_.size() - 1);
  JointStep step{waypoints_[from], Eigen::VectorXd::Zero(waypoints_[from].size()),
                 waypoints_[from].cwiseAbs(), Eigen::VectorXd::Zero(waypoints_[from].size())};
  ObstacleShift obstacle{offsets_[from], Eigen::Vector3d::Zero(), 0.0,
                         obstacle_size_ + offsets_[from].norm()};
  if (from + 1 < waypoints_.size()) {
    const double middle = 0.5 * (first + last) - static_cast<double>(from);
    const double half = 0.5 * (last - first);
    const Eigen::VectorXd change = waypoints_[from + 1] - waypoints_[from];
    step.middle += middle * change;
    step.half = half * change;
    step.sizes += waypoints_[from + 1].cwiseAbs();
    const Eigen::Vector3d shifted = offsets_[from + 1] - offsets_[from];
    obstacle.middle += middle * shifted;
    obstacle.half = half * shifted;
    obstacle.sizes += offsets_[from + 1].norm();
  }
  const fcl::Transform3d pose = robot_.poses(step.middle)[body];
  BodySweep sweep = sweepOf(robot_, body, pose, balls_[body], step);
  makeRelative(obstacle, sweep);
  return {body, first, last, std::move(sweep), 0.0, 1.0};
}

PlacedBody SweptPath::at(std::size_t body, double time) const {
  return {body, between(body, time, time).sweep.middle};
}

/// Over many waypoints: along the line between the first and the last, and off it by what they are.
/// What is between two of them is no farther off than they are.
SweptBody SweptPath::across(std::size_t body, std::size_t first, std::size_t last) const {
  const auto middle = waypointAt(middleOf(static_cast<double>(first), static_cast<double>(last)));
  const Eigen::VectorXd& q = waypoints_[middle];
  const Eigen::VectorXd along = 0.5 * (waypoints_[last] - waypoints_[first]);
  const Eigen::Vector3d shifted = 0.5 * (offsets_[last] - offsets_[first]);
  const double square = along.squaredNorm();
  JointStep step{q, Eigen::VectorXd::Zero(q.size()), q.cwiseAbs(), Eigen::VectorXd::Zero(q.size())};
  ObstacleShift obstacle{offsets_[middle], Eigen::Vector3d::Zero(), 0.0,
                         obstacle_size_ + offsets_[middle].norm()};
  double farthest = 0.0;
  for (std::size_t k = first; k <= last; ++k) {
    const Eigen::VectorXd from_middle = waypoints_[k] - q;
    const double s = square > 0.0 ? from_middle.dot(along) / square : 0.0;
    farthest = std::max(farthest, std::fabs(s));
    step.off = step.off.cwiseMax((from_middle - s * along).cwiseAbs());
    // The lines and what is off them are differences of these, and products with s.
    step.sizes =
        step.sizes.cwiseMax((2.0 + std::fabs(s)) * (waypoints_[k].cwiseAbs() + q.cwiseAbs()));
    obstacle.off = std::max(obstacle.off, (offsets_[k] - offsets_[middle] - s * shifted).norm());
    obstacle.sizes =
        std::max(obstacle.sizes, (2.0 + std::fabs(s)) * (obstacle_size_ + offsets_[k].norm()));
  }
  step.half = farthest * along;
  obstacle.half = farthest * shifted;
  const fcl::Transform3d pose = robot_.poses(q)[body];
  BodySweep sweep = sweepOf(robot_, body, pose, balls_[body], step);
  makeRelative(obstacle, sweep);
  return {body, static_cast<double>(first), static_cast<double>(last), std::move(sweep), 0.0, 1.0};
}

std::vector<SweptBody> SweptPath::wholeSteps() const {
  std::vector<SweptBody> steps;
  const double weight = 1.0 / static_cast<double>(std::max<std::size_t>(bodies_.size(), 1));
  const auto last = static_cast<double>(waypoints_.size() - 1);
  for (const std::size_t body : bodies_) steps.push_back(part(body, 0.0, last, weight));
  return steps;
}

std::vector<SweptBody> SweptPath::halvesOf(const SweptBody& step) const {
  const double weight = 0.5 * step.weight;
  const bool only_waypoints = between_ == BetweenWaypoints::ignored;
  if (only_waypoints || step.last - step.first > 1.0) {
    if (!(step.last > step.first)) return {};
    const double middle = middleOf(step.first, step.last);
    return {part(step.body, step.first, middle, weight),
            part(step.body, only_waypoints ? middle + 1.0 : middle, step.last, weight)};
  }
  const double middle = 0.5 * (step.first + step.last);
  std::vector<SweptBody> halves{part(step.body, step.first, middle, weight),
                                part(step.body, middle, step.last, weight)};
  // Half the way is half the reach, but for what rounding adds to it.
  const bool shorter = std::all_of(halves.begin(), halves.end(), [&](const SweptBody& half) {
    return half.sweep.reach < kMostOfHalf * step.sweep.reach;
  });
  return shorter ? halves : std::vector<SweptBody>();
}

std::size_t SweptPath::statesIn(const SweptBody& step) const {
  if (between_ != BetweenWaypoints::ignored) return 1;
  return static_cast<std::size_t>(step.last - step.first) + 1;
}

}  // namespace fcl_prob::detail
