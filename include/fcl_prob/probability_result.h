// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What a query answers.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fcl_prob/bounds.h"
#include "fcl_prob/probability_request.h"

namespace fcl_prob {

/// On which side of the threshold P is, with certainty.
enum class Decision { none, below, above, undecided };

/// Why a query stopped.
enum class ProbabilityStatus {
  converged,         ///< the tolerance was reached; with a threshold only by method estimate
  exact,             ///< everything is resolved: only the rounding margin is left
  decided,           ///< the threshold was decided
  bound_only,        ///< the method gives one upper bound and has no tolerance to reach
  sampled,           ///< the number of samples asked for was drawn
  time_limit,        ///< the interval is valid but wider than asked for
  cell_limit,        ///< as above
  memory_limit,      ///< as above
  resolution_limit,  ///< as above: what is left cannot be divided further in double precision
  cancelled,         ///< as above, by on_progress
  band_limit         ///< the interval is about as narrow as the bands around the shapes allow
};

/// One of the ways that were tried to answer a query (docs/ARCHITECTURE.md, "The ladder"). Where an
/// answer is made of several, those of one name are one.
struct RungRecord {
  std::string name;
  double seconds = 0.0;
  Bounds known;              ///< of P, certified, after it; of several answers around all of theirs
  std::size_t times = 1;     ///< climbed; 0: left out
  std::size_t answered = 0;  ///< of them, after which nothing more was to be done
  std::string note = {};     ///< what it did, or why it was left out: its line of `plan`
};

/// What the query did. Counters that a method does not use stay 0.
struct ProbabilityStatistics {
  std::size_t cells = 0;         ///< cells of the partition examined
  std::size_t cells_open = 0;    ///< cells left unresolved
  std::size_t pairs_tested = 0;  ///< node pairs tested against a cell, or bounded by general_pcd
  std::size_t leaf_pairs = 0;    ///< pairs of convex pieces whose C-obstacle was built
  std::size_t peak_front = 0;    ///< longest front of a cell
  std::size_t peak_memory = 0;   ///< bytes of the partition's data structures
  std::size_t samples = 0;
  std::size_t hits = 0;
  std::optional<double> effective_samples;  ///< rare_event: (Σ w)² / Σ w² over the weighted hits
  std::optional<double> raw_sum;            ///< general_pcd: the sum before clipping at 1
  std::vector<std::pair<std::string, double>> seconds;  ///< time by stage
  std::vector<RungRecord> rungs;                        ///< of the ladder, in their order
};

struct ProbabilityResult {
  ProbabilityMethod method = ProbabilityMethod::automatic;  ///< the one that answered

  /// Certified: lower <= P <= upper on every input. Not set by sampling methods; `lower` is not set
  /// by methods that only bound from above.
  std::optional<double> lower;
  std::optional<double> upper;

  /// An estimate (not certified) and its standard error, which includes what rounding leaves open
  /// of single samples.
  std::optional<double> estimate;
  std::optional<double> standard_error;

  /// Sampling: an interval that covers P with probability ProbabilityRequest::confidence.
  std::optional<Bounds> confidence_interval;

  /// ∂P/∂mean, 1/metres, world frame, with certified component-wise bounds where the method has
  /// them and a standard error where it samples. With a covariance of rank below 3 set only for
  /// half-spaces and planes, and for an octree with nothing in it: elsewhere P changes with the
  /// mean across the directions in which A does not move by what the boundary of the reachable
  /// section sweeps, and it need not be differentiable; `plan` says so.
  std::optional<Eigen::Vector3d> gradient;
  std::optional<Eigen::Vector3d> gradient_lower;
  std::optional<Eigen::Vector3d> gradient_upper;
  std::optional<Eigen::Vector3d> gradient_standard_error;

  Decision decision = Decision::none;
  ProbabilityStatus status = ProbabilityStatus::converged;

  /// What was used, what was left out, and why: one sentence each.
  std::vector<std::string> plan;

  ProbabilityStatistics statistics;

  /// The single number to use: the estimate if there is one, else the middle of a two-sided
  /// interval, else the upper bound; NaN before any query has filled the result.
  double probability() const;
};

std::string toString(Decision decision);
std::string toString(ProbabilityStatus status);

}  // namespace fcl_prob
