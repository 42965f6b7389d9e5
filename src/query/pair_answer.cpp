// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/pair_answer.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/budget.h"
#include "base/ladder.h"
#include "base/wings.h"
#include "fcl_prob/monte_carlo.h"
#include "query/convex_meshes.h"
#include "query/exact_mass.h"
#include "query/octree_cells.h"
#include "query/partition.h"
#include "query/single_collide.h"
#include "query/unbounded_pair.h"

namespace fcl_prob::detail {
namespace {

/// Cells of two convex shapes, and those of a decision near its threshold, may be divided for
/// minutes. Where the pair may have an exact mass, that is asked for after so many of them; where
/// it has none they are divided again. Of convex shapes it takes about as long as these; of meshes
/// it has first to be found out whether they are convex.
constexpr std::size_t kCellsBeforeExact = 5'000;
constexpr std::size_t kCellsBeforeHull = 20'000;

/// One pair, one question.
class PairAnswer {
 public:
  PairAnswer(const QueryPlan& plan, const PlacedPair& pair,
             const GaussianDisplacement& displacement, const ProbabilityRequest& request)
      : plan_(plan),
        pair_(pair),
        displacement_(displacement),
        request_(request),
        budget_(request),
        known_(request) {
    if (plan.route != Route::partition) return;
    requireDistinctCells(pair.a, pair.b);
    pair.a.solid(request.contact);  // open meshes are refused
    pair.b.solid(request.contact);
  }

  ProbabilityResult answer() {
    climb(kLadder, *this, known_, rungs_);
    result_.plan = planOf(rungs_);
    result_.statistics.rungs = std::move(rungs_);
    return std::move(result_);
  }

 private:
  // The rungs, in their order.
  Climbed collideOnce();
  Climbed answerInClosedForm();
  Climbed boundFromAbove();
  Climbed sample();
  Climbed boundByRoots();
  Climbed answerByConvexMeshes();
  Climbed answerByExactMass();
  Climbed divide();
  Climbed closeByExactMass();
  Climbed divideFurther();

  bool hasCellsLeft() const;
  Climbed take(ProbabilityResult result);

  // Of convex shapes, and of meshes that are convex: nothing in a build without them.
  std::optional<ProbabilityResult> massOf(const ProbabilityRequest& request) const;
  std::optional<ProbabilityResult> meshesMass(const ProbabilityRequest& request) const;

  ProbabilityResult partition(std::size_t most_cells);
  std::size_t firstCells() const;
  void narrowBy(const ProbabilityResult& exact);

  static const std::vector<Rung<PairAnswer>> kLadder;

  const QueryPlan& plan_;
  const PlacedPair& pair_;
  const GaussianDisplacement& displacement_;
  const ProbabilityRequest& request_;
  Budget budget_;
  Known known_;
  std::vector<RungRecord> rungs_;
  ProbabilityResult result_;
};

const std::vector<Rung<PairAnswer>> PairAnswer::kLadder{
    // Where nothing is random, or nothing but the displacement along one normal matters.
    {"one fcl::collide",
     [](const PairAnswer& q) { return unless(q.plan_.route == Route::single_collide); },
     &PairAnswer::collideOnce, true},
    {"closed form",
     [](const PairAnswer& q) { return unless(q.plan_.route == Route::unbounded_pair); },
     &PairAnswer::answerInClosedForm, true},
    // Methods that are asked for by name.
    {"bound",
     [](const PairAnswer& q) {
       return unless(q.plan_.route == Route::convex_bound || q.plan_.route == Route::general_pcd);
     },
     &PairAnswer::boundFromAbove, true},
    {"sampling",
     [](const PairAnswer& q) {
       return unless(q.plan_.route == Route::monte_carlo || q.plan_.route == Route::rare_event);
     },
     &PairAnswer::sample, true},
    {"root volumes", [](const PairAnswer& q) { return q.plan_.why_no_root_bound; },
     &PairAnswer::boundByRoots},
    {"convex meshes", [](const PairAnswer& q) { return q.plan_.why_no_convex_meshes; },
     &PairAnswer::answerByConvexMeshes},
    {"exact mass", [](const PairAnswer& q) { return unless(q.plan_.route == Route::exact_mass); },
     &PairAnswer::answerByExactMass},
    {"partition", nullptr, &PairAnswer::divide, true},
    {"exact mass",
     [](const PairAnswer& q) {
       return unless(q.plan_.exact_if_unresolved || q.plan_.convex_meshes_if_unresolved);
     },
     &PairAnswer::closeByExactMass},
    {"partition", [](const PairAnswer& q) { return unless(q.hasCellsLeft()); },
     &PairAnswer::divideFurther, true},
};

Climbed PairAnswer::take(ProbabilityResult result) {
  result_ = std::move(result);
  known_.narrow(result_);
  return {true, noteOf(result_)};
}

std::optional<ProbabilityResult> PairAnswer::massOf(const ProbabilityRequest& request) const {
  if constexpr (kHasExact) {
    return exactMass(pair_, displacement_, request);
  } else {
    return std::nullopt;
  }
}

std::optional<ProbabilityResult> PairAnswer::meshesMass(const ProbabilityRequest& request) const {
  if constexpr (kHasExact) {
    return convexMeshesMass(pair_, displacement_, request);
  } else {
    return std::nullopt;
  }
}

Climbed PairAnswer::collideOnce() {
  return take(singleCollide(pair_.a.geometry(), pair_.pose_a, pair_.b.geometry(), pair_.pose_b,
                            displacement_.mean(), request_));
}

Climbed PairAnswer::answerInClosedForm() {
  return take(unboundedPairProbability(pair_, displacement_, request_));
}

Climbed PairAnswer::boundFromAbove() {
  return take(plan_.route == Route::convex_bound ? convexBound(pair_, displacement_, request_)
                                                 : generalPcdBound(pair_, displacement_, request_));
}

Climbed PairAnswer::sample() {
  if constexpr (kHasSampling) {
    const auto& [a, pose_a, b, pose_b] = pair_;
    return take(plan_.route == Route::monte_carlo
                    ? monteCarloProbability(a.geometry(), pose_a, b.geometry(), pose_b,
                                            displacement_, request_)
                    : rareEventProbability(a.geometry(), pose_a, b.geometry(), pose_b,
                                           displacement_, request_));
  } else {
    return {false, ""};
  }
}

/// Of two convex meshes neither tree nor cells are needed, unless rounding leaves more of their
/// mass open than the tolerance.
Climbed PairAnswer::answerByConvexMeshes() {
  auto result = meshesMass(request_);
  if (!result) return {false, "a mesh is not convex"};
  if (!isAnswered(result->status)) return {false, "rounding leaves too much of their mass open"};
  result->method = ProbabilityMethod::exact;
  if (request_.method == ProbabilityMethod::estimate) {
    const Bounds bounds{*result->lower, *result->upper};
    result->method = ProbabilityMethod::estimate;
    result->estimate = bounds.middle();
    result->standard_error = 0.5 * bounds.width();
  }
  result->plan.push_back(
      "both meshes are convex: exact mass of their C-obstacle; trees and cells left out");
  return take(std::move(*result));
}

Climbed PairAnswer::boundByRoots() {
  auto result = intervalOfRootBound(pair_, displacement_, request_);
  if (!result) return {false, "their bound decides nothing"};
  return take(std::move(*result));
}

/// Cells are asked where the exact mass leaves more open than the tolerance, or has no gradient; of
/// deviations far below the size it may tell nothing, and cells all.
Climbed PairAnswer::answerByExactMass() {
  Climbed climbed = take(*massOf(request_));
  const bool unresolved = result_.status == ProbabilityStatus::resolution_limit ||
                          (isAnswered(result_.status) && request_.gradient && !result_.gradient);
  const bool is_unknown = *result_.upper - *result_.lower >= 1.0;
  climbed.answered = !unresolved || !(plan_.partition_if_unresolved || is_unknown);
  if (!climbed.answered) climbed.note = "rounding leaves too much open, or there is no gradient";
  return climbed;
}

std::size_t PairAnswer::firstCells() const {
  if (plan_.exact_if_unresolved) return std::min(request_.max_cells, kCellsBeforeExact);
  if (plan_.convex_meshes_if_unresolved && asksForDecision(request_)) {
    return std::min(request_.max_cells, kCellsBeforeHull);
  }
  return request_.max_cells;
}

/// Its rungs are those of this query, too.
ProbabilityResult PairAnswer::partition(std::size_t most_cells) {
  const PartitionObject a{&pair_.a.pieces(), {{pair_.pose_a, pair_.a.solid(request_.contact)}}};
  const PartitionObject b{&pair_.b.pieces(), {{pair_.pose_b, pair_.b.solid(request_.contact)}}};
  ProbabilityRequest request = budget_.withTimeLeft();
  request.max_cells = most_cells;
  ProbabilityResult result = partitionProbability(a, b, displacement_, request);
  auto& rungs = result.statistics.rungs;
  rungs_.insert(rungs_.end(), rungs.begin(), rungs.end());
  return result;
}

/// Cells that are all settled may be so by planes that are widened by more than the tolerance.
Climbed PairAnswer::divide() {
  Climbed climbed = take(partition(firstCells()));
  if (plan_.route == Route::exact_mass) return climbed;
  if (result_.status == ProbabilityStatus::exact) {
    climbed.answered = satisfied({*result_.lower, *result_.upper}, request_).has_value();
  } else {
    climbed.answered = result_.status != ProbabilityStatus::cell_limit &&
                       result_.status != ProbabilityStatus::resolution_limit;
  }
  return climbed;
}

/// Both are bounds of the same probability. An estimate becomes the middle of what is left.
void PairAnswer::narrowBy(const ProbabilityResult& exact) {
  known_.narrow(exact);
  const Bounds& both = known_.interval();
  result_.lower = both.lower;
  result_.upper = both.upper;
  result_.status = exact.status;
  result_.decision = exact.decision;
  if (result_.estimate) {
    result_.estimate = both.middle();
    result_.standard_error = 0.5 * both.width();
  }
  if (!exact.gradient) return;
  result_.gradient = exact.gradient;
  result_.gradient_lower = exact.gradient_lower;
  result_.gradient_upper = exact.gradient_upper;
}

/// Far out in the tail a curved surface takes more cells than the limit, and where deviations are
/// far below the size cells are widened by more than they should; of two convex shapes no cell is
/// needed.
Climbed PairAnswer::closeByExactMass() {
  const ProbabilityRequest rest = budget_.withTimeLeft();
  std::optional<ProbabilityResult> exact;
  if (plan_.exact_if_unresolved) exact = massOf(rest);
  if (plan_.convex_meshes_if_unresolved) exact = meshesMass(rest);
  if (!exact) return {false, "a mesh is not convex"};
  if (!isAnswered(exact->status)) return {false, "it leaves too much open, too"};
  if (request_.gradient && !exact->gradient) return {false, "it has no gradient"};
  narrowBy(*exact);
  return {true, "the cells left too much open: the exact mass of the C-obstacle instead"};
}

bool PairAnswer::hasCellsLeft() const {
  return result_.status == ProbabilityStatus::cell_limit && firstCells() < request_.max_cells;
}

Climbed PairAnswer::divideFurther() { return take(partition(request_.max_cells)); }

}  // namespace

ProbabilityResult pairAnswer(const QueryPlan& plan, const PlacedPair& pair,
                             const GaussianDisplacement& displacement,
                             const ProbabilityRequest& request) {
  return PairAnswer(plan, pair, displacement, request).answer();
}

}  // namespace fcl_prob::detail
