// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Paths whose states a row of Table II allows, and what is certain of them.
#pragma once

#include <optional>
#include <vector>

#include "bench/benchmark.h"
#include "bench/table2_methods.h"
#include "fcl_prob/motion_planning.h"

namespace fcl_prob::cli {

inline constexpr double kMostProbable = 0.05;  ///< the paper's safety level

/// Of one row and one seed.
struct PathRun {
  PlanningStatus status = PlanningStatus::state_limit;
  std::vector<TimedWaypoint> path;  ///< at steps of the planner; empty unless solved
  double length = 0.0;              ///< radians
  std::size_t states = 0;           ///< asked
  double query_ms = 0.0;            ///< of the row's tests, to find and shorten it
  Bounds certified{0.0, 1.0};       ///< contains the largest P of a state of the path

  bool found() const { return status == PlanningStatus::solved; }
  double arrival() const { return path.back().time; }  ///< seconds; of one that was found
};

/// Of one row in one scene.
struct PathRuns {
  std::vector<PathRun> all;  ///< by seed

  std::vector<PathRun> found() const;

  /// P that any state of the first path touches: errors the same all along; obstacles that turn:
  /// of any dependence.
  std::optional<Bounds> motion;
};

class Table2Paths {
 public:
  /// \param scene  must outlive this
  Table2Paths(const Table2Scene& scene, const BenchOptions& options);

  int seeds() const;
  std::size_t states() const;  ///< that a planner may ask for

  /// A path for seed number k, of which the method allows every state below `threshold`; not
  /// certified.
  PathRun plan(const Table2Method& method, int k, double threshold) const;

  /// The same below kMostProbable, certified.
  PathRun run(const Table2Method& method, int k) const;
  Bounds motionOf(const PathRun& run) const;

 private:
  Bounds largestOf(const std::vector<TimedWaypoint>& states) const;

  const Table2Scene& scene_;
  const BenchOptions& options_;
};

}  // namespace fcl_prob::cli
