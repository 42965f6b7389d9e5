// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/convex_meshes.h"

#include <algorithm>

#include "base/budget.h"
#include "base/constants.h"
#include "base/decision.h"
#include "exact/solid_pair.h"
#include "geometry/geometry_kind.h"
#include "query/exact_mass.h"

namespace fcl_prob::detail {
namespace {

bool isSurface(const PreparedGeometry& geometry, ContactMeaning contact) {
  return contact == ContactMeaning::fcl && kindOf(geometry.geometry()) == GeometryKind::mesh;
}

Bounds difference(const Bounds& all, const Bounds& part) {
  // Two roundings; what is below the least double counts as well.
  const double rounding = 2.0 * kEpsilon * all.upper + kUnderflow;
  return {std::max(0.0, all.lower - part.upper - rounding),
          std::max(0.0, all.upper - part.lower + rounding)};
}

}  // namespace

std::optional<ProbabilityResult> convexMeshesMass(const PlacedPair& pair,
                                                  const GaussianDisplacement& displacement,
                                                  const ProbabilityRequest& request) {
  const ConvexSolid *const of_a = pair.a.convexSolid(), *const of_b = pair.b.convexSolid();
  if (!of_a || !of_b) return std::nullopt;
  const PlacedSolid a{*of_a, pair.pose_a}, b{*of_b, pair.pose_b};
  Budget limits(request);
  Bounds mass = solidPairMass(a, b, displacement, limits.interruption());
  const auto leaveOut = [&](Guest guest) {
    mass = difference(mass, containedMass(guest, a, b, displacement, limits.interruption()));
  };
  if (isSurface(pair.b, request.contact)) leaveOut(Guest::a);
  if (isSurface(pair.a, request.contact)) leaveOut(Guest::b);
  ProbabilityResult result;
  result.lower = mass.lower;
  result.upper = std::min(mass.upper, 1.0);
  result.decision = decisionOf({*result.lower, *result.upper}, request);
  const bool is_exact = asksForDecision(request) && mass.width() <= kRoundingWidth * mass.upper;
  const auto otherwise = is_exact ? ProbabilityStatus::exact : ProbabilityStatus::resolution_limit;
  result.status = satisfied(mass, request).value_or(otherwise);
  return result;
}

}  // namespace fcl_prob::detail
