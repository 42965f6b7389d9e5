// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/exact_mass.h"

#include <algorithm>

#include "fcl_prob/convex_pcd.h"
#include "query/single_collide.h"

namespace fcl_prob::detail {
namespace {

/// Four times the points leave a quarter of the gap, at four to sixteen times the cost.
constexpr int kRefinement = 4;
constexpr int kFinestResolution = 16 * 92;

/// What rounding leaves of the mass of a polytope.
constexpr double kRoundingWidth = 1e-9;

bool isFlat(const PlacedPair& pair) {
  return pair.a.rootBody().isPolytope() && pair.b.rootBody().isPolytope();
}

}  // namespace

ProbabilityResult exactMass(const PlacedPair& pair, const GaussianDisplacement& displacement,
                            const ProbabilityRequest& request) {
  Bounds mass =
      convexPairMass(pair.a.rootBody(), pair.pose_a, pair.b.rootBody(), pair.pose_b, displacement);
  const auto decided = [&] {
    const Decision decision = decisionOf(mass, request);
    return decision == Decision::below || decision == Decision::above;
  };
  const auto converged = [&] {
    return mass.width() <=
           std::max(request.absolute_tolerance, request.relative_tolerance * mass.upper);
  };
  const auto exact = [&] { return isFlat(pair) || mass.width() <= kRoundingWidth * mass.upper; };
  int resolution = ConvexBody::kDefaultResolution;
  while (!exact() && !converged() && !decided() && resolution < kFinestResolution) {
    resolution *= kRefinement;
    const Bounds finer =
        convexPairMass(ConvexBody(pair.a.geometry(), resolution), pair.pose_a,
                       ConvexBody(pair.b.geometry(), resolution), pair.pose_b, displacement);
    mass = {std::max(mass.lower, finer.lower), std::min(mass.upper, finer.upper)};
  }
  ProbabilityResult result;
  result.method = ProbabilityMethod::exact;
  result.lower = mass.lower;
  result.upper = mass.upper;
  result.decision = decisionOf(mass, request);
  result.status = exact()       ? ProbabilityStatus::exact
                  : decided()   ? ProbabilityStatus::decided
                  : converged() ? ProbabilityStatus::converged
                                : ProbabilityStatus::resolution_limit;
  result.statistics.leaf_pairs = 1;
  if (!isFlat(pair) && !exact()) {
    result.plan.push_back("curved sides between polytopes of " + std::to_string(resolution) +
                          " points");
  }
  return result;
}

}  // namespace fcl_prob::detail
