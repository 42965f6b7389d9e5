// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/pair_query.h"

#include <utility>

#include "base/until_no.h"
#include "base/wings.h"
#include "cells/without_contact.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/monte_carlo.h"
#include "geometry/occupancy.h"
#include "geometry/validation.h"
#include "query/mixture_query.h"
#include "query/pair_answer.h"
#include "query/plan_notes.h"

namespace fcl_prob::detail {
namespace {

/// Whether fcl::collide itself is asked at random displacements.
bool samples(const QueryPlan& plan) {
  return plan.route == Route::monte_carlo || plan.route == Route::rare_event;
}

}  // namespace

ProbabilityResult PairQuery::answer(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                                    const GaussianDisplacement& displacement,
                                    const ProbabilityRequest& request) const {
  if (request.contact == ContactMeaning::contained) {
    return answerContained(pose_a, pose_b, displacement, request);
  }
  ProbabilityResult result = answerOfGaussian(pose_a, pose_b, displacement, ofOneCall(request));
  noteTolerance(request, result);
  return result;
}

ProbabilityResult PairQuery::answer(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                                    const GaussianMixture& displacement,
                                    const ProbabilityRequest& request) const {
  if (request.contact == ContactMeaning::contained) {
    return answerContained(pose_a, pose_b, displacement, request);
  }
  validateRequest(request);
  if (request.method == ProbabilityMethod::monte_carlo) {
    if constexpr (!kHasSampling) {
      refuseWithout(toString(request.method), "SAMPLING");
    } else {
      ProbabilityResult result = monteCarloProbability(a_->geometry(), pose_a, b_->geometry(),
                                                       pose_b, displacement, request);
      noteTolerance(request, result);
      return result;
    }
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
  ProbabilityResult result = pairAnswer(plan, {*a_, pose_a, *b_, pose_b}, displacement, request);
  result.plan.insert(result.plan.begin(), plan.notes.begin(), plan.notes.end());
  if (auto note = sizeNote(*a_, *b_, displacement)) result.plan.push_back(std::move(*note));
  return result;
}

}  // namespace fcl_prob::detail
