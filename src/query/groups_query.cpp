// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/groups_query.h"

#include <algorithm>
#include <utility>

#include "base/decision.h"
#include "base/until_no.h"
#include "fcl_prob/combined_bounds.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/parts_bounds.h"
#include "geometry/occupancy.h"
#include "geometry/validation.h"
#include "narrowphase/convex_pair_mass.h"
#include "partition/motion_flux.h"
#include "partition/partition.h"
#include "partition/without_contact.h"
#include "query/call_budget.h"
#include "query/mixture_query.h"
#include "query/motion_gradient.h"
#include "query/octree_cells.h"
#include "query/request_limits.h"
#include "query/single_collide.h"
#include "query/tolerance_note.h"
#include "query/truncation.h"
#include "query/union_of_pairs.h"

namespace fcl_prob::detail {
namespace {

/// Of the threshold: what may be left out of the sums that decide it.
constexpr double kNegligible = 1e-6;

/// One union of pieces must do for all pairs of members.
void requireAlike(const MemberGroup& group, const MemberGroup& others) {
  if (!others.hasOcTree()) return;
  for (const auto& member : group.members()) {
    if (!isAlikeBesideOcTrees(member->geometry())) {
      throw UnsupportedGeometry(nodeTypeName(member->geometry().getNodeType()) +
                                " both occupied and free in a group that meets an octree: "
                                "fcl::collide leaves it out there and nowhere else");
    }
    for (const auto& other : others.members()) {
      requireDistinctCells(*member, *other);
    }
  }
}

/// Of the time limit, for a first sum of bounds that is seldom the answer.
constexpr double kShareOfRootBounds = 0.1;

void requireMethod(const ProbabilityRequest& request) {
  switch (request.method) {
    case ProbabilityMethod::automatic:
    case ProbabilityMethod::interval:
    case ProbabilityMethod::estimate:
      return;
    default:
      throw UnsupportedGeometry("method " + toString(request.method) +
                                " cannot handle groups of several geometries");
  }
}

std::optional<ProbabilityResult> intervalOfSum(double most, const ProbabilityRequest& request) {
  const auto status = satisfied({0.0, most}, request);
  if (!status) return std::nullopt;
  ProbabilityResult result;
  result.method = ProbabilityMethod::interval;
  result.lower = 0.0;
  result.upper = most;
  result.status = *status;
  result.decision = decisionOf({0.0, most}, request);
  result.plan.push_back("far apart: stopped at the sum of the bounds of all pairs");
  return result;
}

}  // namespace

GroupsQuery::GroupsQuery(PreparedGeometries group_a, PreparedGeometries group_b)
    : a_(std::move(group_a), "group A"), b_(std::move(group_b), "group B") {
  if (a_.members().size() == 1 && b_.members().size() == 1) {
    single_.emplace(a_.members()[0], b_.members()[0]);
  } else if (a_.anyUnbounded() && b_.anyUnbounded()) {
    throw UnsupportedGeometry("both groups have unbounded members");
  } else {
    requireAlike(a_, b_);
    requireAlike(b_, a_);
  }
}

void GroupsQuery::validate(const Poses& poses_a, const Poses& poses_b,
                           const ProbabilityRequest& request) const {
  validateRequest(request);
  a_.validate(poses_a);
  b_.validate(poses_b);
  if (!single_) requireMethod(request);
}

ProbabilityResult GroupsQuery::answer(const Poses& poses_a, const Poses& poses_b,
                                      const GaussianDisplacement& displacement,
                                      const ProbabilityRequest& request) const {
  validate(poses_a, poses_b, request);
  if (single_) return single_->answer(poses_a[0], poses_b[0], displacement, request);
  ProbabilityResult result = answerOfGaussian(poses_a, poses_b, displacement, ofOneCall(request));
  noteTolerance(request, result);
  return result;
}

ProbabilityResult GroupsQuery::answer(const Poses& poses_a, const Poses& poses_b,
                                      const GaussianMixture& displacement,
                                      const ProbabilityRequest& request) const {
  validate(poses_a, poses_b, request);
  if (single_) return single_->answer(poses_a[0], poses_b[0], displacement, request);
  return mixtureProbability(
      displacement, ofOneCall(request),
      [&](const GaussianDisplacement& component, const ProbabilityRequest& of_component) {
        return answerOfGaussian(poses_a, poses_b, component, of_component);
      });
}

ProbabilityResult GroupsQuery::answer(const Poses& poses_a, const Poses& poses_b,
                                      const TruncatedGaussian& displacement,
                                      const ProbabilityRequest& request) const {
  validate(poses_a, poses_b, request);
  if (single_) return single_->answer(poses_a[0], poses_b[0], displacement, request);
  const ProbabilityRequest of_call = ofOneCall(request);
  const TruncatedQuery truncated(displacement, of_call);
  ProbabilityResult result;
  if (truncated.isWhole()) {
    result =
        answerOfGaussian(poses_a, poses_b, displacement.gaussian(), truncated.requestOfContact());
    truncated.ofContact(result);
  } else {
    result = answerOfGaussian(poses_a, poses_b, displacement.gaussian(), truncated.requestOfJoint(),
                              &truncated.ball());
    truncated.ofJoint(result);
  }
  noteTolerance(request, result);
  return result;
}

/// \param ball  null: the displacement is not truncated; else the request is that of meeting and
/// being within it
ProbabilityResult GroupsQuery::answerOfGaussian(const Poses& poses_a, const Poses& poses_b,
                                                const GaussianDisplacement& displacement,
                                                const ProbabilityRequest& request,
                                                const BallTruncation* ball) const {
  if (a_.isEmpty() || b_.isEmpty()) return withoutContact(request, note());
  const CallBudget budget(request);
  PlacedGroup placed_a(a_, poses_a, request.contact);
  PlacedGroup placed_b(b_, poses_b, request.contact);
  if (request.hasBand() && (a_.anyUnbounded() || b_.anyUnbounded())) {
    throw UnsupportedGeometry("a group with unbounded members knows no bands around its shapes");
  }
  const double most = sumOfRootBounds(poses_a, poses_b, displacement, request);
  if (auto far = intervalOfSum(most, request)) return *far;
  // Those bounds are of contact, not of contact within an ellipsoid.
  if (!ball && !request.hasBand()) {
    if (auto decided = decidedByPairs(poses_a, poses_b, displacement, request)) return *decided;
    if (auto sum = unionOfPairs(a_, poses_a, b_, poses_b, displacement, request)) {
      sum->plan.insert(sum->plan.begin(), note());
      return *sum;
    }
  }
  // At most one of the two has unbounded members.
  placed_a.boundBy(placed_b.object(), displacement);
  placed_b.boundBy(placed_a.object(), displacement);
  ProbabilityResult result = partitionProbability(
      placed_a.object(), placed_b.object(), displacement, withTimeLeft(request, budget), ball);
  if (displacement.rank() == 0 && !request.hasBand() && *result.lower < *result.upper) {
    return collided(poses_a, poses_b, displacement.mean(), request);
  }
  result.upper = std::max(*result.lower, std::min(*result.upper, most));
  result.plan.insert(result.plan.begin(), note() + ": one partition for the union of their pairs");
  return result;
}

MotionGradient GroupsQuery::gradient(const Poses& poses_a, const Poses& poses_b,
                                     const GaussianDisplacement& displacement,
                                     const MemberVelocities& velocities,
                                     const MotionGradientRequest& request) const {
  a_.validate(poses_a);
  b_.validate(poses_b);
  validateVelocities(velocities, a_.members().size());
  validateGradient(request);
  if (displacement.rank() == 0) {
    throw InvalidRequest("a displacement of rank 0 has no gradient: P is 0 or 1");
  }
  if (a_.isEmpty() || b_.isEmpty()) return withoutGradient(velocities[0].cols());
  PlacedGroup placed_a(a_, poses_a, request.contact);
  PlacedGroup placed_b(b_, poses_b, request.contact);
  placed_a.boundBy(placed_b.object(), displacement);
  placed_b.boundBy(placed_a.object(), displacement);
  const MotionGradientRequest of_call = ofOneCall(request);
  LimitedLines limited(of_call);
  MemberVelocities of_parts;
  for (const std::size_t i : a_.bounded()) of_parts.push_back(velocities[i]);
  for (const std::size_t i : a_.unbounded()) of_parts.push_back(velocities[i]);
  const MeanAndError flux =
      motionFlux(placed_a.object(), placed_b.object(), displacement, of_parts, limited.draws());
  return gradientFrom(flux, limited.status());
}

/// Without a displacement, where the partition cannot tell: what fcl::collide says, as for pairs.
ProbabilityResult GroupsQuery::collided(const Poses& poses_a, const Poses& poses_b,
                                        const Eigen::Vector3d& moved,
                                        const ProbabilityRequest& request) const {
  ProbabilityResult result;
  for (std::size_t i = 0; i < poses_a.size(); ++i) {
    for (std::size_t j = 0; j < poses_b.size(); ++j) {
      result = singleCollide(a_.members()[i]->geometry(), poses_a[i], b_.members()[j]->geometry(),
                             poses_b[j], moved, request);
      if (*result.upper > 0.0) return result;
    }
  }
  return result;
}

/// Bound on the sum over all pairs, 1 where there is none that is of use.
double GroupsQuery::sumOfRootBounds(const Poses& poses_a, const Poses& poses_b,
                                    const GaussianDisplacement& displacement,
                                    const ProbabilityRequest& request) const {
  const bool wanted =
      !request.gradient && !request.hasBand() && request.method != ProbabilityMethod::estimate;
  if (!wanted || !a_.haveRootBodies() || !b_.haveRootBodies()) return 1.0;
  RequestLimits limits(request, kShareOfRootBounds);
  // A larger sum ends no query.
  const double useful = request.threshold.value_or(request.absolute_tolerance);
  std::vector<Bounds> pairs;
  double sum = 0.0;
  for (std::size_t i = 0; i < poses_a.size(); ++i) {
    for (std::size_t j = 0; j < poses_b.size(); ++j) {
      const double bound =
          convexPcd(a_.members()[i]->rootBody(), poses_a[i], b_.members()[j]->rootBody(),
                    poses_b[j], displacement, limits.interruption())
              .least;
      sum += bound;
      if (sum > useful || limits.reason()) return 1.0;
      pairs.push_back({0.0, bound});
    }
  }
  return anyOf(pairs).upper;
}

/// Convex members in one place, as the parts of a mesh are: sums of masses may decide the
/// threshold, and no partition is begun.
std::optional<ProbabilityResult> GroupsQuery::decidedByPairs(
    const Poses& poses_a, const Poses& poses_b, const GaussianDisplacement& displacement,
    const ProbabilityRequest& request) const {
  if (!request.threshold || request.gradient || request.method == ProbabilityMethod::estimate) {
    return std::nullopt;
  }
  if (!a_.areConvex() || !b_.areConvex()) return std::nullopt;
  const fcl::Transform3d* const place_a = a_.onePlace(poses_a);
  const fcl::Transform3d* const place_b = b_.onePlace(poses_b);
  if (!place_a || !place_b) return std::nullopt;
  RequestLimits limits(request);
  PartsBoundsRequest parts;
  parts.negligible = kNegligible * *request.threshold;
  parts.interruption = limits.interruption();
  const PartsBoundsResult bounds =
      partsBounds(a_.bodies(), *place_a, b_.bodies(), *place_b, displacement, parts);
  const Decision decision = decisionOf(bounds.any, request);
  if (decision != Decision::below && decision != Decision::above) return std::nullopt;
  ProbabilityResult result;
  result.method = ProbabilityMethod::interval;
  result.lower = bounds.any.lower;
  result.upper = bounds.any.upper;
  result.status = ProbabilityStatus::decided;
  result.decision = decision;
  result.statistics.leaf_pairs = bounds.pairs;
  result.plan = {note(), "decided by Hunter's and Bonferroni's bounds on pairs of convex members"};
  return result;
}

std::string GroupsQuery::note() const {
  const std::size_t left_out = a_.leftOut() + b_.leftOut();
  return "groups of " + std::to_string(a_.members().size()) + " and " +
         std::to_string(b_.members().size()) +
         (left_out > 0
              ? " (" + std::to_string(left_out) + " left out, as fcl::collide does: not occupied)"
              : "");
}

}  // namespace fcl_prob::detail
