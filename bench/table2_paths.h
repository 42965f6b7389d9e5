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

/// Of one seed.
struct FoundPath {
  std::vector<Eigen::VectorXd> states;  ///< at steps of the planner
  double length = 0.0;                  ///< radians
  double query_ms = 0.0;                ///< of the row's tests, to find and shorten it
  Bounds certified{0.0, 1.0};           ///< contains the largest P of a state
};

/// Of one row in one scene; a number a seed.
struct PathRuns {
  std::vector<double> states, query_ms;
  int refused = 0;  ///< start or goal is
  std::vector<FoundPath> found;

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

  /// A path for seed number k, of which the method allows every state below `threshold`.
  PlanningResult plan(const Table2Method& method, int k, double threshold, double& query_ms) const;

  void run(const Table2Method& method, int k, PathRuns& runs) const;
  Bounds motionOf(const FoundPath& path) const;

 private:
  Bounds largestOf(const std::vector<Eigen::VectorXd>& states) const;

  const Table2Scene& scene_;
  const BenchOptions& options_;
};

/// The states of a path as they are asked for.
std::vector<Eigen::VectorXd> statesOf(const PlanningResult& plan);

}  // namespace fcl_prob::cli
