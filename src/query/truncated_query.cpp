// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Displacements that stay within an ellipsoid: P(contact and inside) / P(inside).
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "fcl_prob/exceptions.h"
#include "gaussian/constants.h"
#include "geometry/occupancy.h"
#include "geometry/validation.h"
#include "partition/partition.h"
#include "partition/without_contact.h"
#include "query/bounded_part.h"
#include "query/octree_cells.h"
#include "query/pair_query.h"
#include "query/single_collide.h"

namespace fcl_prob::detail {
namespace {

void validateTruncatedRequest(const ProbabilityRequest& request) {
  validateRequest(request);
  if (request.method != ProbabilityMethod::automatic &&
      request.method != ProbabilityMethod::interval) {
    throw UnsupportedGeometry("method " + toString(request.method) +
                              " cannot handle truncated displacements");
  }
  if (request.gradient) throw InvalidRequest("no gradient for a truncated displacement");
}

/// Bounds on P given the ellipsoid, of bounds on P(contact and inside).
Bounds conditional(const Bounds& joint, const Bounds& inside) {
  return {std::clamp(joint.lower / inside.upper * (1 - 4 * kEpsilon), 0.0, 1.0),
          inside.lower > 0.0 ? std::clamp(joint.upper / inside.lower * (1 + 4 * kEpsilon), 0.0, 1.0)
                             : 1.0};
}

/// Bounds on P(contact and inside), of bounds on P(contact).
Bounds joint(const Bounds& contact, const BallMass& ball) {
  return {std::max(0.0, contact.lower - ball.outside.upper),
          std::min(contact.upper, ball.inside.upper)};
}

/// The interval turns into that of the conditional probability; what follows from it is taken anew.
void makeConditional(const Bounds& of_joint, const BallMass& ball,
                     const ProbabilityRequest& request, ProbabilityResult& result) {
  const Bounds bounds = conditional(of_joint, ball.inside);
  result.lower = bounds.lower;
  result.upper = bounds.upper;
  result.decision = decisionOf(bounds, request);
  const bool decided = result.decision == Decision::below || result.decision == Decision::above;
  const double tolerance =
      std::max(request.absolute_tolerance, request.relative_tolerance * bounds.upper);
  if (decided) {
    result.status = ProbabilityStatus::decided;
  } else if (bounds.width() > tolerance && (result.status == ProbabilityStatus::converged ||
                                            result.status == ProbabilityStatus::decided ||
                                            result.status == ProbabilityStatus::exact)) {
    result.status = ProbabilityStatus::resolution_limit;
  } else if (result.status == ProbabilityStatus::decided) {
    result.status = ProbabilityStatus::converged;
  }
}

/// The request with an on_progress that hears of the conditional probability, where the query that
/// it is for knows the bounds that `convert` turns into those.
template <typename Convert>
ProbabilityRequest withConditionalProgress(const ProbabilityRequest& request,
                                           const Convert& convert) {
  ProbabilityRequest result = request;
  if (!request.on_progress) return result;
  result.on_progress = [&request, convert](const ProbabilityProgress& known) {
    ProbabilityProgress progress = known;
    progress.interval = convert(known.interval);
    return request.on_progress(progress);
  };
  return result;
}

/// One side of the pair as the partition takes it; an unbounded shape as far as it can be reached.
struct PairSide {
  std::shared_ptr<const PieceTree> stand_in;
  PartitionObject object;
};

PairSide boundedSide(const PreparedGeometry& geometry, const fcl::Transform3d& pose,
                     ContactMeaning contact) {
  return {nullptr, {&geometry.pieces(), {{pose, geometry.solid(contact)}}}};
}

PairSide reachedSide(const PreparedGeometry& unbounded, const fcl::Transform3d& pose,
                     const PartitionObject& other, const GaussianDisplacement& gaussian) {
  const BoundedPart part =
      boundedPart(unbounded.geometry(), pose, reachedBall(other, gaussian, kReach));
  PairSide side{buildPieceTree(*part.geometry), {}};
  side.object = {side.stand_in.get(), {{part.pose, nullptr}}};
  return side;
}

}  // namespace

ProbabilityResult PairQuery::answer(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                                    const TruncatedGaussian& displacement,
                                    const ProbabilityRequest& request) const {
  validateTruncatedRequest(request);
  validatePose(pose_a, "object A");
  validatePose(pose_b, "object B");
  if (const auto why = whyNeverInContact(a_->geometry(), b_->geometry())) {
    return withoutContact(request, *why);
  }
  requireDistinctCells(*a_, *b_);
  const GaussianDisplacement& gaussian = displacement.gaussian();
  const BallMass mass = ballMass(displacement.deviations(), gaussian.rank());
  const bool both_unbounded = !a_->hasPieces() && !b_->hasPieces();
  // Nothing is cut off that could be noticed.
  const bool whole = gaussian.rank() == 0 || displacement.deviations() >= kReach;
  if (whole || both_unbounded) {
    const auto of_contact = withConditionalProgress(request, [mass](const Bounds& contact) {
      return conditional(joint(contact, mass), mass.inside);
    });
    ProbabilityResult result = answer(pose_a, pose_b, gaussian, of_contact);
    makeConditional(joint({*result.lower, *result.upper}, mass), mass, request, result);
    result.plan.push_back("truncated displacement: enclosed by the mass outside the ellipsoid");
    return result;
  }
  ProbabilityRequest of_joint = withConditionalProgress(
      request, [mass](const Bounds& joint) { return conditional(joint, mass.inside); });
  of_joint.absolute_tolerance *= mass.inside.lower;
  if (of_joint.threshold) *of_joint.threshold *= mass.inside.middle();
  if (!(of_joint.absolute_tolerance + of_joint.relative_tolerance > 0.0)) {
    of_joint.absolute_tolerance = std::numeric_limits<double>::min();
  }
  PairSide side_a, side_b;
  if (a_->hasPieces()) side_a = boundedSide(*a_, pose_a, request.contact);
  if (b_->hasPieces()) side_b = boundedSide(*b_, pose_b, request.contact);
  if (!a_->hasPieces()) side_a = reachedSide(*a_, pose_a, side_b.object, gaussian);
  if (!b_->hasPieces()) side_b = reachedSide(*b_, pose_b, side_a.object, gaussian);
  const BallTruncation ball(displacement.deviations());
  ProbabilityResult result =
      partitionProbability(side_a.object, side_b.object, gaussian, of_joint, &ball);
  makeConditional({*result.lower, *result.upper}, mass, request, result);
  result.plan.push_back("truncated displacement: a partition of the ellipsoid");
  return result;
}

}  // namespace fcl_prob::detail
