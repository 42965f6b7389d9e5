// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Pairs whose displacement stays within an ellipsoid.
#include <memory>

#include "base/budget.h"
#include "base/until_no.h"
#include "cells/without_contact.h"
#include "fcl_prob/exceptions.h"
#include "geometry/occupancy.h"
#include "geometry/validation.h"
#include "query/bounded_part.h"
#include "query/octree_cells.h"
#include "query/pair_query.h"
#include "query/partition.h"
#include "query/plan_notes.h"
#include "query/truncation.h"

namespace fcl_prob::detail {
namespace {

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
                                    const ProbabilityRequest& of_user) const {
  if (of_user.contact == ContactMeaning::contained) {
    return answerContained(pose_a, pose_b, displacement, of_user);
  }
  const ProbabilityRequest request = ofOneCall(of_user);
  const TruncatedQuery truncated(displacement, request);
  validatePose(pose_a, "object A");
  validatePose(pose_b, "object B");
  if (const auto why = whyNeverInContact(a_->geometry(), b_->geometry())) {
    return withoutContact(request, *why);
  }
  requireDistinctCells(*a_, *b_);
  const Budget budget(request);
  const GaussianDisplacement& gaussian = displacement.gaussian();
  ProbabilityResult result;
  if (truncated.isWhole() || (!a_->hasPieces() && !b_->hasPieces())) {
    result = answerOfGaussian(pose_a, pose_b, gaussian, truncated.requestOfContact());
    truncated.ofContact(result);
  } else {
    if (request.hasBand() && (!a_->hasPieces() || !b_->hasPieces())) {
      throw UnsupportedGeometry(
          "bands around shapes, beside a half-space or plane: not for truncated displacements");
    }
    PairSide side_a, side_b;
    if (a_->hasPieces()) side_a = boundedSide(*a_, pose_a, request.contact);
    if (b_->hasPieces()) side_b = boundedSide(*b_, pose_b, request.contact);
    if (!a_->hasPieces()) side_a = reachedSide(*a_, pose_a, side_b.object, gaussian);
    if (!b_->hasPieces()) side_b = reachedSide(*b_, pose_b, side_a.object, gaussian);
    ProbabilityRequest joint = truncated.requestOfJoint();
    budget.shareTime(1, joint);
    result = partitionProbability(side_a.object, side_b.object, gaussian, joint, &truncated.ball());
    truncated.ofJoint(result);
  }
  noteTolerance(request, result);
  return result;
}

}  // namespace fcl_prob::detail
