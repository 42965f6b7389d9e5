// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/table2_paths.h"

#include <algorithm>

#include "base/stopwatch.h"

namespace fcl_prob::cli {
namespace {

constexpr double kLargestStep = 0.05;  // radians
constexpr std::size_t kStates = 1'500;
constexpr std::size_t kStatesIfQuick = 300;

ProbabilityRequest certifyingRequest() {
  ProbabilityRequest request;
  request.relative_tolerance = 0.05;
  request.absolute_tolerance = 1e-5;
  request.max_cells = 2'000;
  return request;
}

}  // namespace

std::vector<Eigen::VectorXd> statesOf(const PlanningResult& plan) {
  return interpolated(plan.waypoints, kLargestStep);
}

Table2Paths::Table2Paths(const Table2Scene& scene, const BenchOptions& options)
    : scene_(scene), options_(options) {}

int Table2Paths::seeds() const { return options_.quick ? 2 : 10; }

std::size_t Table2Paths::states() const {
  return options_.states.value_or(options_.quick ? kStatesIfQuick : kStates);
}

PlanningResult Table2Paths::plan(const Table2Method& method, int k, double threshold,
                                 double& query_ms) const {
  const StateTest test = [&](const Eigen::VectorXd& values) {
    if (!scene_.isFree(values)) return false;
    const detail::Stopwatch watch;
    const bool below = method.probability(scene_.at(values), threshold) < threshold;
    query_ms += watch.milliseconds();
    return below;
  };
  PlanningRequest request;
  request.joints = scene_.joints;
  request.largest_step = kLargestStep;
  request.seed = options_.seed + static_cast<std::uint64_t>(k);
  request.max_states = states();
  return planMotion(scene_.robot(), test, scene_.start, scene_.goal, request);
}

void Table2Paths::run(const Table2Method& method, int k, PathRuns& runs) const {
  double query_ms = 0.0;
  const PlanningResult plan = this->plan(method, k, kMostProbable, query_ms);
  runs.states.push_back(static_cast<double>(plan.states));
  runs.query_ms.push_back(query_ms);
  runs.refused +=
      plan.status == PlanningStatus::start_refused || plan.status == PlanningStatus::goal_refused;
  if (plan.status != PlanningStatus::solved) return;
  FoundPath path{statesOf(plan), plan.length, query_ms};
  path.certified = largestOf(path.states);
  if (method.answer == Table2Answer::certified) {
    // Every state was decided, which may have taken more than the interval's cells.
    path.certified.upper = std::min(path.certified.upper, kMostProbable);
  }
  runs.found.push_back(std::move(path));
}

Bounds Table2Paths::largestOf(const std::vector<Eigen::VectorXd>& states) const {
  Bounds largest{0.0, 0.0};
  for (const Eigen::VectorXd& values : states) {
    const Bounds one = scene_.at(values).query.state(values, certifyingRequest()).any;
    largest = {std::max(largest.lower, one.lower), std::max(largest.upper, one.upper)};
  }
  return largest;
}

Bounds Table2Paths::motionOf(const FoundPath& path) const {
  ProbabilityRequest request = certifyingRequest();
  request.max_cells *= 10;
  if (scene_.around.size() == 1) {
    return scene_.around[0]->query.motion(path.states, ErrorsOverTime::persistent, request).any;
  }
  std::vector<Obstacle> obstacles = scene_.obstacles();
  for (const Eigen::VectorXd& values : path.states) {
    const std::vector<Obstacle>& by_then = scene_.at(values).query.obstacles();
    for (std::size_t j = 0; j < obstacles.size(); ++j) {
      obstacles[j].over_time.push_back({by_then[j].pose, by_then[j].displacement});
    }
  }
  return scene_.around[0]
      ->query.withObstacles(std::move(obstacles))
      .motion(path.states, ErrorsOverTime::any_dependence, request)
      .any;
}

}  // namespace fcl_prob::cli
