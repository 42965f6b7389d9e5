// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/table2_paths.h"

#include <algorithm>
#include <iterator>

#include "base/stopwatch.h"

namespace fcl_prob::cli {
namespace {

constexpr double kLargestStep = 0.05;     // radians
constexpr double kLargestTimeStep = 0.1;  // seconds: as often as arms are predicted
constexpr std::size_t kStates = 1'500;
constexpr std::size_t kStatesIfQuick = 300;

ProbabilityRequest certifyingRequest() {
  ProbabilityRequest request;
  request.relative_tolerance = 0.05;
  request.absolute_tolerance = 1e-5;
  request.max_cells = 2'000;
  return request;
}

void fill(const PlanningResult& plan, PathRun& run) {
  run.status = plan.status;
  run.length = plan.length;
  run.states = plan.states;
  for (const Eigen::VectorXd& values : interpolated(plan.waypoints, kLargestStep)) {
    run.path.push_back({0.0, values});
  }
}

void fill(const TimedPlan& plan, PathRun& run) {
  run.status = plan.status;
  run.length = plan.length;
  run.states = plan.states;
  run.path = interpolated(plan.waypoints, kLargestStep, kLargestTimeStep);
}

}  // namespace

std::vector<PathRun> PathRuns::found() const {
  std::vector<PathRun> found;
  std::copy_if(all.begin(), all.end(), std::back_inserter(found),
               [](const PathRun& run) { return run.found(); });
  return found;
}

Table2Paths::Table2Paths(const Table2Scene& scene, const BenchOptions& options)
    : scene_(scene), options_(options) {}

int Table2Paths::seeds() const { return options_.quick ? 2 : 10; }

std::size_t Table2Paths::states() const {
  return options_.states.value_or(options_.quick ? kStatesIfQuick : kStates);
}

PathRun Table2Paths::plan(const Table2Method& method, int k, double threshold) const {
  PathRun run;
  const TimedStateTest test = [&](double time, const Eigen::VectorXd& values) {
    if (!scene_.isFree(values)) return false;
    const detail::Stopwatch watch;
    const bool below = method.probability(scene_.at({time, values}), threshold) < threshold;
    run.query_ms += watch.milliseconds();
    return below;
  };
  TimedPlanningRequest request;
  request.planning.joints = scene_.joints;
  request.planning.largest_step = kLargestStep;
  request.planning.seed = options_.seed + static_cast<std::uint64_t>(k);
  request.planning.max_states = states();
  request.largest_time_step = kLargestTimeStep;
  request.latest = scene_.end;
  if (scene_.isTimed()) {
    fill(planInTime(scene_.robot(), test, scene_.start, scene_.goal, request), run);
  } else {
    const StateTest always = [&](const Eigen::VectorXd& values) { return test(0.0, values); };
    fill(planMotion(scene_.robot(), always, scene_.start, scene_.goal, request.planning), run);
  }
  return run;
}

PathRun Table2Paths::run(const Table2Method& method, int k) const {
  PathRun run = plan(method, k, kMostProbable);
  if (!run.found()) return run;
  run.certified = largestOf(run.path);
  if (method.answer == Table2Answer::certified) {
    // Every state was decided, which may have taken more than the interval's cells.
    run.certified.upper = std::min(run.certified.upper, kMostProbable);
  }
  return run;
}

Bounds Table2Paths::largestOf(const std::vector<TimedWaypoint>& states) const {
  Bounds largest{0.0, 0.0};
  for (const TimedWaypoint& state : states) {
    const Bounds one = scene_.at(state).query.state(state.values, certifyingRequest()).any;
    largest = {std::max(largest.lower, one.lower), std::max(largest.upper, one.upper)};
  }
  return largest;
}

Bounds Table2Paths::motionOf(const PathRun& run) const {
  ProbabilityRequest request = certifyingRequest();
  request.max_cells *= 10;
  std::vector<Eigen::VectorXd> states;
  for (const TimedWaypoint& state : run.path) states.push_back(state.values);
  if (!scene_.isTimed()) {
    return scene_.around[0]->query.motion(states, ErrorsOverTime::persistent, request).any;
  }
  std::vector<Obstacle> obstacles = scene_.obstacles();
  for (const TimedWaypoint& state : run.path) {
    const std::vector<Obstacle>& by_then = scene_.at(state).query.obstacles();
    for (std::size_t j = 0; j < obstacles.size(); ++j) {
      obstacles[j].over_time.push_back({by_then[j].pose, by_then[j].displacement});
    }
  }
  return scene_.around[0]
      ->query.withObstacles(std::move(obstacles))
      .motion(states, ErrorsOverTime::any_dependence, request)
      .any;
}

}  // namespace fcl_prob::cli
