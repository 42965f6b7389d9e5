// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Collision probabilities through FCL's broad-phase managers.
#pragma once

#include <fcl/broadphase/broadphase_collision_manager.h>
#include <fcl/narrowphase/collision_object.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob {

struct BroadphaseRequest {
  /// Of every pair. Its limits on time, cells and samples are those of the whole call: pairs share
  /// them, and one that used up its share is asked again for what others left. Cancelling by its
  /// on_progress ends the call.
  ProbabilityRequest query;

  /// How an object is displaced, world frame, metres. Displacements of different objects are
  /// independent: a pair has that of A minus that of B. Not set: nothing is displaced.
  std::function<GaussianDisplacement(const fcl::CollisionObjectd&)> displacement;

  /// Optional: pairs for which it returns false (neighbouring links, allowed contacts) count as
  /// never colliding.
  std::function<bool(const fcl::CollisionObjectd&, const fcl::CollisionObjectd&)> considers;

  /// Pairs whose bounding boxes meet with at most this probability are left out; what they may
  /// contribute is added to the upper bound. In (0, 0.5).
  double culling_probability = 1e-12;

  /// Stop as soon as the lower bound of P(any) is above this.
  std::optional<double> stop_above;
};

struct PairProbability {
  const fcl::CollisionObjectd* a;
  const fcl::CollisionObjectd* b;
  ProbabilityResult result;
};

struct BroadphaseResult {
  std::vector<PairProbability> pairs;  ///< those that were answered, in the order of the managers
  std::size_t pairs_culled = 0;        ///< left out as out of reach

  /// No less than the sum of the probabilities of all pairs that were culled.
  double culled_upper = 0.0;

  /// stop_above was exceeded: pairs that are neither answered nor culled were not looked at.
  bool stopped = false;

  /// The limit that ended the call before all pairs were answered, or `cancelled`: the same holds.
  std::optional<ProbabilityStatus> interrupted;

  /// P(any pair collides), whatever the dependence between the pairs: see anyOf(). Certified; a
  /// method without lower bounds counts them as 0, one without upper bounds as 1, and so does a
  /// pair that was not looked at.
  Bounds any;
};

/// `object` against everything in the manager. Any of FCL's managers will do: it is asked for its
/// objects and nothing else, so that it need be neither set up nor up to date, and what is infinite
/// (which some managers never report) is not missed. Boxes are computed from the geometries and
/// poses as they are. An object that is registered twice counts once; `object` itself is skipped
/// where the manager holds it. `result` is assigned only on success. \returns the middle of
/// result.any \throws what a single query throws, InvalidRequest if a manager is null or
/// culling_probability is out of range
double collisionProbability(const fcl::CollisionObjectd* object,
                            const fcl::BroadPhaseCollisionManagerd* manager,
                            const BroadphaseRequest& request, BroadphaseResult& result);

/// Everything in one manager (A) against everything in another (B). Two objects that are in both
/// are one pair.
double collisionProbability(const fcl::BroadPhaseCollisionManagerd* manager_a,
                            const fcl::BroadPhaseCollisionManagerd* manager_b,
                            const BroadphaseRequest& request, BroadphaseResult& result);

/// All pairs within one manager.
double collisionProbability(const fcl::BroadPhaseCollisionManagerd* manager,
                            const BroadphaseRequest& request, BroadphaseResult& result);

/// For callers who drive a manager themselves: pass this as the callback and `&data` as its data.
/// Answers every pair that the manager reports, which are those whose undisplaced bounding boxes
/// meet, and keeps data.result.any up to date as if there were no others. The functions above
/// enlarge the boxes and account for the rest.
struct ProbabilityCallbackData {
  BroadphaseRequest request;
  BroadphaseResult result;
};
bool collisionProbabilityCallback(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data);

}  // namespace fcl_prob
