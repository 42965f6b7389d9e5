// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/obstacle_motion.h"

#include <algorithm>
#include <utility>

#include "base/budget.h"
#include "base/decision.h"
#include "base/statistics.h"
#include "robot/moving_obstacle.h"

namespace fcl_prob::detail {
namespace {

// Of so many placed bodies it is worth asking some first, which tells what may be left out; and of
// how many, to what relative tolerance.
constexpr std::size_t kMany = 400;
constexpr std::size_t kSome = 64;
constexpr double kToleranceOfSome = 0.3;

// What is between waypoints is asked for after the waypoints, to this tolerance.
constexpr double kToleranceOfWaypoints = 0.1;

// Of the limits: what a first question takes of them.
constexpr double kShareOfSoon = 0.125;

// A question of which only the lower end counts, P being at least that.
ProbabilityRequest soon(double tolerance, const Budget& budget, const ProbabilityRequest& request) {
  ProbabilityRequest soon = request;
  soon.threshold.reset();
  soon.relative_tolerance = std::max(tolerance, request.relative_tolerance);
  budget.share(1, soon, budget.left().part(1.0 - kShareOfSoon));
  if (!request.on_progress) return soon;
  soon.on_progress = [told = request.on_progress](ProbabilityProgress progress) {
    progress.interval.upper = 1.0;
    return told(progress);
  };
  return soon;
}

}  // namespace

ProbabilityResult ObstacleMotion::atWaypoints(const ProbabilityRequest& request,
                                              FarBodies& left_out) const {
  if (placed_.size() <= kMany || request.method == ProbabilityMethod::estimate) {
    return among_.ask(obstacle_, placed_, request, left_out);
  }
  // Mostly by steps that are long.
  if (asksForDecision(request)) return sweptWaypoints({0.0, 1.0}, request, left_out);
  Budget budget(request);
  const ProbabilityResult some = atSome(budget, request);
  budget.spend(some.statistics);
  ProbabilityRequest rest = request;
  budget.share(1, rest);
  ProbabilityResult result = ofMany(rest, some.lower.value_or(0.0), left_out);
  addStatistics(some.statistics, result.statistics);
  return result;
}

ProbabilityResult ObstacleMotion::soonAtWaypoints(const Budget& budget,
                                                  const ProbabilityRequest& request) const {
  FarBodies unused;
  return atWaypoints(soon(kToleranceOfWaypoints, budget, request), unused);
}

// P is at least that of every so many of them.
ProbabilityResult ObstacleMotion::atSome(const Budget& budget,
                                         const ProbabilityRequest& request) const {
  std::vector<PlacedBody> bodies;
  const std::size_t step = placed_.size() / kSome;
  for (std::size_t i = 0; i < placed_.size(); i += step) bodies.push_back(placed_[i]);
  FarBodies unused;
  return among_.ask(obstacle_, bodies, soon(kToleranceOfSome, budget, request), unused);
}

std::size_t ObstacleMotion::memoryOf(const std::vector<PlacedBody>& bodies) const {
  std::size_t bytes = 0;
  for (const PlacedBody& one : bodies) bytes += treeMemory(*among_.geometries()[one.body]);
  return bytes;
}

ProbabilityResult ObstacleMotion::ofMany(const ProbabilityRequest& request, double least,
                                         FarBodies& left_out) const {
  std::vector<PlacedBody> bodies = placed_;
  const double far =
      leaveOutUnlikely(among_.sceneOf(obstacle_), stateAt(among_.obstacles()[obstacle_], 0),
                       mostFarOf(request, least), bodies);
  const std::size_t memory = memoryOf(bodies);
  if (memory > mostTreeMemory(request)) return sweptWaypoints({least, 1.0}, request, left_out);
  ProbabilityResult result = besidesFar(far, request, [&](const ProbabilityRequest& of_near) {
    ProbabilityRequest besides_trees = of_near;
    besides_trees.max_memory -= memory;
    return among_.ask(obstacle_, bodies, besides_trees, left_out);
  });
  if (result.lower) result.lower = std::max(*result.lower, least);
  left_out.count += placed_.size() - bodies.size();
  left_out.upper += far;
  return result;
}

ProbabilityResult ObstacleMotion::sweptWaypoints(const Bounds& known,
                                                 const ProbabilityRequest& request,
                                                 FarBodies& left_out) const {
  SweptAnswer answer = swept(BetweenWaypoints::ignored, known, request);
  left_out = {answer.far, answer.far_upper};
  return std::move(answer.result);
}

SweptAnswer ObstacleMotion::atAllTimes(const Bounds& known,
                                       const ProbabilityRequest& request) const {
  return swept(BetweenWaypoints::swept, known, request);
}

SweptAnswer ObstacleMotion::swept(BetweenWaypoints between, const Bounds& known,
                                  const ProbabilityRequest& request) const {
  std::vector<std::size_t> bodies;
  for (const std::size_t i : among_.bodiesOf(obstacle_)) {
    if (body_ < 0 || i == static_cast<std::size_t>(body_)) bodies.push_back(i);
  }
  const Obstacle& obstacle = among_.obstacles()[obstacle_];
  const SweptPath path(among_.robot(), among_.balls(), waypoints_, std::move(bodies), obstacle,
                       between);
  return sweptMotion(path, among_.sceneOf(obstacle_), stateAt(obstacle, 0),
                     mostFarOf(request, known.lower), known, request);
}

}  // namespace fcl_prob::detail
