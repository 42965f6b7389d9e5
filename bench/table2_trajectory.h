// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// One trajectory of Table II, each state of which every row bounds: what the paper's table has.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/table2_methods.h"

namespace fcl_prob::cli {

/// What a row says of the states of a trajectory.
struct TrajectoryRow {
  std::string name;
  std::string published;          ///< as Table2Method::published
  std::optional<double> largest;  ///< P of a state, sums as they are; nothing: it decides
  std::optional<double> certain;  ///< that is the upper end of an interval; its lower end
  std::optional<int> below;       ///< states below kMostProbable by it, or that it decided for
  int too_small = 0;              ///< of which it says less than is certain; not told of padding
  double time_ms = 0.0;           ///< of all states
};

/// P of its states is below this: what the paper's Monte Carlo row has for both its trajectories.
inline constexpr double kMostOfTrajectory = 0.01;

/// The states of a path.
class Trajectory {
 public:
  /// \param scene  must outlive this
  Trajectory(const Table2Scene& scene, std::vector<TimedWaypoint> states);

  std::size_t size() const { return states_.size(); }

  /// Certified intervals, which the other rows are compared with, and an estimate.
  TrajectoryRow interval();
  TrajectoryRow estimate(std::uint64_t seed) const;

  /// Any row, after interval(); a decision is at kMostOfTrajectory.
  TrajectoryRow row(const Table2Method& method) const;

 private:
  const Table2Scene& scene_;
  std::vector<TimedWaypoint> states_;
  std::vector<Bounds> certified_;
};

}  // namespace fcl_prob::cli
