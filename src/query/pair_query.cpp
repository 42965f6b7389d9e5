// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/pair_query.h"

#include <algorithm>

#include "base/decision.h"
#include "base/until_no.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/monte_carlo.h"
#include "gaussian/agreed_bounds.h"
#include "geometry/occupancy.h"
#include "geometry/validation.h"
#include "partition/partition.h"
#include "partition/without_contact.h"
#include "query/call_budget.h"
#include "query/convex_meshes.h"
#include "query/exact_mass.h"
#include "query/mixture_query.h"
#include "query/octree_cells.h"
#include "query/single_collide.h"
#include "query/tolerance_note.h"
#include "query/unbounded_pair.h"

namespace fcl_prob::detail {
namespace {

/// Whether fcl::collide itself is asked at random displacements.
bool samples(const QueryPlan& plan) {
  return plan.route == Route::monte_carlo || plan.route == Route::rare_event;
}

/// Cells that are all settled may be so by planes that are widened by more than the tolerance.
bool leavesTooMuch(const ProbabilityResult& result, const ProbabilityRequest& request) {
  if (result.status == ProbabilityStatus::exact) {
    return !satisfied({*result.lower, *result.upper}, request);
  }
  return result.status == ProbabilityStatus::cell_limit ||
         result.status == ProbabilityStatus::resolution_limit;
}

/// Cells of two convex shapes, and those of a decision near its threshold, may be divided for
/// minutes. Where the pair may have an exact mass, that is asked for after so many of them; where
/// it has none they are divided again. Of convex shapes it takes about as long as these; of meshes
/// it has first to be found out whether they are convex.
constexpr std::size_t kCellsBeforeExact = 5'000;
constexpr std::size_t kCellsBeforeHull = 20'000;

/// Both are bounds of the same probability. An estimate becomes the middle of what is left.
void takeCertified(const ProbabilityResult& other, ProbabilityResult& result) {
  const Bounds both = agreed({*result.lower, *result.upper}, {*other.lower, *other.upper});
  result.lower = both.lower;
  result.upper = both.upper;
  result.status = other.status;
  result.decision = other.decision;
  if (result.estimate) {
    result.estimate = both.middle();
    result.standard_error = 0.5 * both.width();
  }
  if (!other.gradient) return;
  result.gradient = other.gradient;
  result.gradient_lower = other.gradient_lower;
  result.gradient_upper = other.gradient_upper;
}

}  // namespace

ProbabilityResult PairQuery::answer(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                                    const GaussianDisplacement& displacement,
                                    const ProbabilityRequest& request) const {
  ProbabilityResult result = answerOfGaussian(pose_a, pose_b, displacement, ofOneCall(request));
  noteTolerance(request, result);
  return result;
}

ProbabilityResult PairQuery::answer(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                                    const GaussianMixture& displacement,
                                    const ProbabilityRequest& request) const {
  validateRequest(request);
  if (request.method == ProbabilityMethod::monte_carlo) {
    ProbabilityResult result = monteCarloProbability(a_->geometry(), pose_a, b_->geometry(), pose_b,
                                                     displacement, request);
    noteTolerance(request, result);
    return result;
  }
  return mixtureProbability(
      displacement, ofOneCall(request),
      [&](const GaussianDisplacement& component, const ProbabilityRequest& of_component) {
        return answer(pose_a, pose_b, component, of_component);
      });
}

ProbabilityResult PairQuery::answerOfGaussian(const fcl::Transform3d& pose_a,
                                              const fcl::Transform3d& pose_b,
                                              const GaussianDisplacement& displacement,
                                              const ProbabilityRequest& request) const {
  validateRequest(request);
  validatePose(pose_a, "object A");
  validatePose(pose_b, "object B");
  const QueryPlan plan = planQuery(*a_, *b_, displacement, request);
  if (const auto why = whyNeverInContact(a_->geometry(), b_->geometry()); why && !samples(plan)) {
    return withoutContact(request, *why);
  }
  ProbabilityResult result = follow(plan, {*a_, pose_a, *b_, pose_b}, displacement, request);
  result.plan.insert(result.plan.begin(), plan.notes.begin(), plan.notes.end());
  return result;
}

ProbabilityResult PairQuery::follow(const QueryPlan& plan, const PlacedPair& pair,
                                    const GaussianDisplacement& displacement,
                                    const ProbabilityRequest& request) const {
  switch (plan.route) {
    case Route::single_collide:
      return singleCollide(a_->geometry(), pair.pose_a, b_->geometry(), pair.pose_b,
                           displacement.mean(), request);
    case Route::partition:
      return partitionOrExact(plan, pair, displacement, request);
    case Route::unbounded_pair:
      return unboundedPairProbability(pair, displacement, request);
    case Route::exact_mass:
      return exact(plan, pair, displacement, request);
    case Route::convex_bound:
      return convexBound(pair, displacement, request);
    case Route::general_pcd:
      return generalPcdBound(pair, displacement, request);
    case Route::monte_carlo:
      return monteCarloProbability(a_->geometry(), pair.pose_a, b_->geometry(), pair.pose_b,
                                   displacement, request);
    case Route::rare_event:
      return rareEventProbability(a_->geometry(), pair.pose_a, b_->geometry(), pair.pose_b,
                                  displacement, request);
  }
  throw InvalidRequest("no such route");
}

ProbabilityResult PairQuery::exact(const QueryPlan& plan, const PlacedPair& pair,
                                   const GaussianDisplacement& displacement,
                                   const ProbabilityRequest& request) const {
  const CallBudget budget(request);
  if (plan.try_root_bound) {
    auto result = intervalOfRootBound(pair, displacement, request);
    if (result) return *result;
  }
  ProbabilityResult result = exactMass(pair, displacement, request);
  const bool unresolved = result.status == ProbabilityStatus::resolution_limit ||
                          (isAnswered(result.status) && request.gradient && !result.gradient);
  // Of deviations far below the size an exact mass may tell nothing, and cells all.
  const bool is_unknown = *result.upper - *result.lower >= 1.0;
  if (!unresolved || !(plan.partition_if_unresolved || is_unknown)) return result;
  ProbabilityResult other = partition(plan, pair, displacement,
                                      request.time_limit ? withTimeLeft(request, budget) : request);
  other.plan.insert(other.plan.begin(),
                    "rounding leaves too much of the exact mass open: partition");
  return other;
}

ProbabilityResult PairQuery::partition(const QueryPlan& plan, const PlacedPair& pair,
                                       const GaussianDisplacement& displacement,
                                       const ProbabilityRequest& request) const {
  requireDistinctCells(*a_, *b_);
  const CallBudget budget(request);
  // Open meshes are refused wherever the shapes are.
  const ClosedMesh* const solid_a = a_->solid(request.contact);
  const ClosedMesh* const solid_b = b_->solid(request.contact);
  if (plan.try_root_bound) {
    auto result = intervalOfRootBound(pair, displacement, request);
    if (result) return *result;
  }
  const PartitionObject a{&a_->pieces(), {{pair.pose_a, solid_a}}};
  const PartitionObject b{&b_->pieces(), {{pair.pose_b, solid_b}}};
  if (!request.time_limit) return partitionProbability(a, b, displacement, request);
  return partitionProbability(a, b, displacement, withTimeLeft(request, budget));
}

/// Of two convex meshes neither tree nor cells are needed. Nothing where rounding leaves more of
/// their mass open than the tolerance.
std::optional<ProbabilityResult> PairQuery::convexMeshes(const QueryPlan& plan,
                                                         const PlacedPair& pair,
                                                         const GaussianDisplacement& displacement,
                                                         const ProbabilityRequest& request) const {
  if (!plan.convex_meshes_first) return std::nullopt;
  auto result = convexMeshesMass(pair, displacement, request);
  if (!result || !isAnswered(result->status)) return std::nullopt;
  result->method = ProbabilityMethod::exact;
  if (request.method == ProbabilityMethod::estimate) {
    const Bounds bounds{*result->lower, *result->upper};
    result->method = ProbabilityMethod::estimate;
    result->estimate = bounds.middle();
    result->standard_error = 0.5 * bounds.width();
  }
  result->plan.push_back(
      "both meshes are convex: exact mass of their C-obstacle; trees and cells left out");
  return result;
}

/// Far out in the tail a curved surface takes more cells than the limit, and where deviations are
/// far below the size cells are widened by more than they should; of two convex shapes no cell is
/// needed.
ProbabilityResult PairQuery::partitionOrExact(const QueryPlan& plan, const PlacedPair& pair,
                                              const GaussianDisplacement& displacement,
                                              const ProbabilityRequest& request) const {
  if (auto exact = convexMeshes(plan, pair, displacement, request)) return *exact;
  const CallBudget budget(request);
  const auto rest = [&] { return request.time_limit ? withTimeLeft(request, budget) : request; };
  ProbabilityRequest first = request;
  if (plan.exact_if_unresolved) {
    first.max_cells = std::min(first.max_cells, kCellsBeforeExact);
  } else if (plan.convex_meshes_if_unresolved && asksForDecision(request)) {
    first.max_cells = std::min(first.max_cells, kCellsBeforeHull);
  }
  ProbabilityResult result = partition(plan, pair, displacement, first);
  if (!leavesTooMuch(result, request)) return result;
  if (closeByExactMass(plan, pair, displacement, rest(), result)) return result;
  const bool has_cells_left =
      result.status == ProbabilityStatus::cell_limit && first.max_cells < request.max_cells;
  return has_cells_left ? partition(plan, pair, displacement, rest()) : result;
}

/// Whether there is an exact mass, which then is the result.
bool PairQuery::closeByExactMass(const QueryPlan& plan, const PlacedPair& pair,
                                 const GaussianDisplacement& displacement,
                                 const ProbabilityRequest& request,
                                 ProbabilityResult& result) const {
  std::optional<ProbabilityResult> exact;
  if (plan.exact_if_unresolved) exact = exactMass(pair, displacement, request);
  if (plan.convex_meshes_if_unresolved) exact = convexMeshesMass(pair, displacement, request);
  if (!exact || !isAnswered(exact->status)) return false;
  if (request.gradient && !exact->gradient) return false;
  takeCertified(*exact, result);
  result.plan.push_back("the cells left too much open: the exact mass of the C-obstacle instead");
  return true;
}

}  // namespace fcl_prob::detail
