// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/table2_trajectory.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/stopwatch.h"
#include "bench/table2_paths.h"

namespace fcl_prob::cli {
namespace {

constexpr double kSamples = 10'000.0;

// A share of samples is that many standard errors below P by chance hardly ever.
constexpr double kManyErrors = 5.0;

ProbabilityRequest requestOf(ProbabilityMethod method) {
  ProbabilityRequest request;
  request.method = method;
  request.relative_tolerance = 0.05;
  request.absolute_tolerance = 1e-4;
  request.max_cells = 20'000;
  return request;
}

bool saysProbability(const Table2Method& method) {
  return method.answer == Table2Answer::counted || method.answer == Table2Answer::upper_bound;
}

/// Whether a method's number is less than it may be.
bool isTooSmall(const Table2Method& method, double said, double certainly) {
  switch (method.answer) {
    case Table2Answer::upper_bound:
      return said < certainly;
    case Table2Answer::counted:
      return said + kManyErrors * std::sqrt(certainly / kSamples) < certainly;
    case Table2Answer::certified:
    case Table2Answer::probable:
      return said < kMostOfTrajectory && certainly >= kMostOfTrajectory;
    case Table2Answer::padding:
      break;
  }
  return false;
}

}  // namespace

Trajectory::Trajectory(const Table2Scene& scene, std::vector<TimedWaypoint> states)
    : scene_(scene), states_(std::move(states)) {
  // What depends on the geometries only is prepared before any clock is started, by other states.
  ProbabilityRequest request = requestOf(ProbabilityMethod::interval);
  request.relative_tolerance = 0.5;
  for (std::size_t k = 0; k + 1 < states_.size(); ++k) {
    const Eigen::VectorXd between = 0.5 * (states_[k].values + states_[k + 1].values);
    scene_.at(states_[k]).query.state(between, request);
  }
}

TrajectoryRow Trajectory::interval() {
  TrajectoryRow row;
  row.name = "certified interval, 5 %";
  Bounds largest{0.0, 0.0};
  const detail::Stopwatch watch;
  for (const TimedWaypoint& state : states_) {
    const RobotQuery& query = scene_.at(state).query;
    certified_.push_back(query.state(state.values, requestOf(ProbabilityMethod::interval)).any);
    if (certified_.back().upper > largest.upper) largest = certified_.back();
  }
  row.time_ms = watch.milliseconds();
  row.largest = largest.upper;
  row.certain = largest.lower;
  return row;
}

TrajectoryRow Trajectory::estimate(std::uint64_t seed) const {
  TrajectoryRow row;
  row.name = "estimate, 5 %";
  ProbabilityRequest request = requestOf(ProbabilityMethod::estimate);
  request.seed = seed;
  double largest = 0.0;
  const detail::Stopwatch watch;
  for (const TimedWaypoint& state : states_) {
    largest = std::max(largest, scene_.at(state).query.state(state.values, request).probability());
  }
  row.time_ms = watch.milliseconds();
  row.largest = largest;
  return row;
}

TrajectoryRow Trajectory::row(const Table2Method& method) const {
  TrajectoryRow row;
  row.name = method.name;
  row.published = method.published;
  const double enough =
      saysProbability(method) ? std::numeric_limits<double>::infinity() : kMostOfTrajectory;
  std::vector<double> said;
  const detail::Stopwatch watch;
  for (const TimedWaypoint& state : states_) {
    said.push_back(method.probability(scene_.at(state), enough));
  }
  row.time_ms = watch.milliseconds() / method.repetitions;
  for (std::size_t k = 0; k < said.size(); ++k) {
    row.too_small += isTooSmall(method, std::min(1.0, said[k]), certified_[k].lower);
  }
  row.below = static_cast<int>(
      std::count_if(said.begin(), said.end(), [](double p) { return p < kMostProbable; }));
  if (saysProbability(method)) {
    row.largest = *std::max_element(said.begin(), said.end());
  }
  return row;
}

}  // namespace fcl_prob::cli
