// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/truncation.h"

#include <algorithm>
#include <limits>

#include "base/constants.h"
#include "base/decision.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob::detail {
namespace {

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

}  // namespace

void validateTruncatedRequest(const ProbabilityRequest& request) {
  validateRequest(request);
  if (request.method != ProbabilityMethod::automatic &&
      request.method != ProbabilityMethod::interval) {
    throw UnsupportedGeometry("method " + toString(request.method) +
                              " cannot handle truncated displacements");
  }
  if (request.gradient) throw InvalidRequest("no gradient for a truncated displacement");
}

TruncatedQuery::TruncatedQuery(const TruncatedGaussian& displacement,
                               const ProbabilityRequest& request)
    : displacement_(displacement),
      request_(request),
      ball_(displacement.deviations()),
      mass_(ballMass(displacement.deviations(), displacement.gaussian().rank())) {
  validateTruncatedRequest(request);
}

bool TruncatedQuery::isWhole() const {
  return displacement_.gaussian().rank() == 0 || displacement_.deviations() >= kReach;
}

Bounds TruncatedQuery::joint(const Bounds& contact) const {
  return {std::max(0.0, contact.lower - mass_.outside.upper),
          std::min(contact.upper, mass_.inside.upper)};
}

Bounds TruncatedQuery::conditional(const Bounds& joint) const {
  const Bounds& inside = mass_.inside;
  return {std::clamp(joint.lower / inside.upper * (1 - 4 * kEpsilon) - kUnderflow, 0.0, 1.0),
          inside.lower > 0.0
              ? std::clamp(joint.upper / inside.lower * (1 + 4 * kEpsilon) + kUnderflow, 0.0, 1.0)
              : 1.0};
}

ProbabilityRequest TruncatedQuery::requestOfContact() const {
  return withConditionalProgress(
      request_, [this](const Bounds& contact) { return conditional(joint(contact)); });
}

void TruncatedQuery::ofContact(ProbabilityResult& result) const {
  makeConditional(joint({*result.lower, *result.upper}), result);
  result.plan.push_back("truncated displacement: enclosed by the mass outside the ellipsoid");
}

ProbabilityRequest TruncatedQuery::requestOfJoint() const {
  ProbabilityRequest of_joint =
      withConditionalProgress(request_, [this](const Bounds& joint) { return conditional(joint); });
  of_joint.absolute_tolerance *= mass_.inside.lower;
  if (of_joint.threshold) *of_joint.threshold *= mass_.inside.middle();
  if (!(of_joint.absolute_tolerance + of_joint.relative_tolerance > 0.0)) {
    of_joint.absolute_tolerance = std::numeric_limits<double>::min();
  }
  return of_joint;
}

void TruncatedQuery::ofJoint(ProbabilityResult& result) const {
  makeConditional({*result.lower, *result.upper}, result);
  result.plan.push_back("truncated displacement: a partition of the ellipsoid");
}

/// The interval turns into that of the conditional probability; what follows from it is taken anew.
void TruncatedQuery::makeConditional(const Bounds& of_joint, ProbabilityResult& result) const {
  const Bounds bounds = conditional(of_joint);
  result.lower = bounds.lower;
  result.upper = bounds.upper;
  result.decision = decisionOf(bounds, request_);
  const bool is_exact = result.status == ProbabilityStatus::exact &&
                        bounds.width() <= request_.toleranceAt(bounds.upper);
  if (isDecided(result.decision)) {
    result.status = ProbabilityStatus::decided;
  } else if (isAnswered(result.status) && !is_exact) {
    result.status = satisfied(bounds, request_).value_or(ProbabilityStatus::resolution_limit);
  }
}

}  // namespace fcl_prob::detail
