// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/groups_query.h"

#include <algorithm>
#include <utility>

#include "base/until_no.h"
#include "cells/without_contact.h"
#include "fcl_prob/exceptions.h"
#include "geometry/occupancy.h"
#include "geometry/validation.h"
#include "lines/motion_flux.h"
#include "query/certified_answer.h"
#include "query/groups_answer.h"
#include "query/mixture_query.h"
#include "query/motion_gradient.h"
#include "query/octree_cells.h"
#include "query/partition.h"
#include "query/plan_notes.h"
#include "query/truncation.h"

namespace fcl_prob::detail {
namespace {

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

}  // namespace

GroupsQuery::GroupsQuery(PreparedGeometries group_a, PreparedGeometries group_b,
                         const std::string& name_a, const std::string& name_b, Poses about_a)
    : a_(std::move(group_a), name_a, std::move(about_a)), b_(std::move(group_b), name_b) {
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
  a_.validate(poses_a);
  b_.validate(poses_b);
  if (single_) return;  // a pair has more requests
  validateRequest(request);
  requireMethod(request);
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
  ProbabilityResult result =
      truncatedAnswer(displacement, ofOneCall(request),
                      [&](const GaussianDisplacement& gaussian,
                          const ProbabilityRequest& of_gaussian, const BallTruncation* ball) {
                        return answerOfGaussian(poses_a, poses_b, gaussian, of_gaussian, ball);
                      });
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
  if (request.hasBand() && (a_.anyUnbounded() || b_.anyUnbounded())) {
    throw UnsupportedGeometry("a group with unbounded members knows no bands around its shapes");
  }
  return groupsAnswer({a_, poses_a, b_, poses_b, note()}, displacement, request, ball);
}

// What fcl::collide finds depends on more than the shapes where members are not alike: of a pair,
// too, a certificate is then of nothing that it would find.
ProbabilityResult GroupsQuery::certified(const Poses& poses_a, const Poses& poses_b,
                                         const GaussianDisplacement& displacement,
                                         const ProbabilityRequest& request,
                                         std::ostream& certificate) const {
  validateRequest(request);
  validate(poses_a, poses_b, request);
  requireAlike(a_, b_);
  requireAlike(b_, a_);
  if (a_.isEmpty() || b_.isEmpty()) throw UnsupportedGeometry("no certificate of " + note());
  ProbabilityResult result =
      certifiedAnswer({a_, poses_a}, {b_, poses_b}, displacement, ofOneCall(request), certificate);
  noteTolerance(request, result);
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

std::string GroupsQuery::note() const {
  const std::size_t left_out = a_.leftOut() + b_.leftOut();
  return "groups of " + std::to_string(a_.members().size()) + " and " +
         std::to_string(b_.members().size()) +
         (left_out > 0
              ? " (" + std::to_string(left_out) + " left out, as fcl::collide does: not occupied)"
              : "");
}

}  // namespace fcl_prob::detail
