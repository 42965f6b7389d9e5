// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// One pair of geometries at many poses: a trajectory, or a cloud of predictions.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "fcl_prob/collision_probability.h"
#include "fcl_prob/mixture.h"

namespace fcl_prob {

/// Poses in the world frame, metres, and the displacement of A relative to B there.
struct Waypoint {
  fcl::Transform3d pose_a = fcl::Transform3d::Identity();
  fcl::Transform3d pose_b = fcl::Transform3d::Identity();
  Displacement displacement;  ///< a Gaussian, a mixture or a truncated Gaussian
};

/// Stops a running batch from any thread; cannot be taken back.
class CancellationToken {
 public:
  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> cancelled_{false};
};

struct BatchProgress {
  std::size_t done = 0;  ///< waypoints answered
  std::size_t total = 0;
};

struct BatchRequest {
  /// Of every waypoint. Its `threads` are used for the waypoints, each of which is answered on one
  /// thread; its limits, `time_limit` included, are those of one waypoint, so that an answer does
  /// not depend on how many others there are; its `on_progress` must not be set.
  ProbabilityRequest query;

  /// Called after every waypoint, from the thread that answered it, never from two at once;
  /// returning false cancels the batch.
  std::function<bool(const BatchProgress&)> on_progress;

  /// Optional; must outlive the call.
  const CancellationToken* cancellation = nullptr;
};

struct BatchResult {
  /// In the order of the waypoints. Not set where the batch was cancelled before the answer was
  /// complete; what is set is the same as that of a single query, whatever the number of threads.
  std::vector<std::optional<ProbabilityResult>> waypoints;

  std::size_t done = 0;  ///< entries that are set
  bool cancelled = false;

  /// Bounds on the probability that there is contact at any waypoint, whatever the dependence
  /// between the displacements of different waypoints (see anyOf()): at least the largest lower
  /// bound, at most the sum of the upper bounds. A waypoint without a lower bound counts as 0, one
  /// without an upper bound (not answered, or only sampled) as 1. Says nothing of the motion
  /// between two waypoints.
  Bounds path;
};

/// Answers every waypoint on request.query.threads threads. \throws what a single query throws,
/// for the first offending waypoint, before any work; InvalidRequest if request.query.on_progress
/// is set. An exception that a geometry causes during the work (UnsupportedGeometry, OpenMesh) ends
/// the batch.
BatchResult collisionProbabilities(const PreparedQuery& query,
                                   const std::vector<Waypoint>& waypoints,
                                   const BatchRequest& request);

}  // namespace fcl_prob
