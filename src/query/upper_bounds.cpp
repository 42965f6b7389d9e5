// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/upper_bounds.h"

#include <algorithm>

#include "base/budget.h"
#include "base/decision.h"
#include "base/wings.h"
#include "bounds/convex_bound.h"
#include "fcl_prob/general_pcd.h"

namespace fcl_prob::detail {
namespace {

/// Of the time limit, for a first bound that is seldom the answer.
constexpr double kShareOfRootBound = 0.1;

double rootBound(const PlacedPair& pair, const GaussianDisplacement& displacement, Budget& limits) {
  return detail::convexPcd(pair.a.rootBody(), pair.pose_a, pair.b.rootBody(), pair.pose_b,
                           displacement, limits.interruption())
      .least;
}

ProbabilityResult boundedBy(double upper, const ProbabilityRequest& request) {
  ProbabilityResult result;
  result.method = request.method;
  result.upper = upper;
  result.status = ProbabilityStatus::bound_only;
  result.decision = decisionOf({0.0, upper}, request);
  return result;
}

}  // namespace

ProbabilityResult convexBound(const PlacedPair& pair, const GaussianDisplacement& displacement,
                              const ProbabilityRequest& request) {
  Budget limits(request);
  ProbabilityResult result = boundedBy(rootBound(pair, displacement, limits), request);
  result.status = limits.stopped().value_or(result.status);
  result.statistics.pairs_tested = 1;
  result.plan.push_back(
      "ConvexPCD: the least of the bounds by half-space, box and divergence theorem");
  return result;
}

ProbabilityResult generalPcdBound(const PlacedPair& pair, const GaussianDisplacement& displacement,
                                  const ProbabilityRequest& request) {
  if constexpr (!kHasPaper) {
    refuseWithout(toString(request.method), "PAPER");
  } else {
    Budget limits(request);
    GeneralPcdRequest pcd_request;
    pcd_request.interruption = limits.interruption();
    pcd_request.confidence = request.confidence;
    pcd_request.max_pairs = request.max_cells;
    pcd_request.variant = request.method == ProbabilityMethod::general_pcd_min
                              ? GeneralPcdVariant::minimum
                              : GeneralPcdVariant::sum;
    const GeneralPcdResult pcd = generalPcd(pair.a.geometry(), pair.pose_a, pair.b.geometry(),
                                            pair.pose_b, displacement, pcd_request);
    ProbabilityResult result = boundedBy(pcd.upper, request);
    if (!pcd.complete) result.status = limits.stopped().value_or(ProbabilityStatus::cell_limit);
    result.statistics.raw_sum = pcd.raw_sum;
    result.statistics.pairs_tested = pcd.pairs_bounded;
    result.statistics.leaf_pairs = pcd.leaf_pairs;
    result.plan.push_back(
        "GeneralPCD over the bounding volume trees: " + std::to_string(pcd.pairs_bounded) +
        " pairs bounded, their sum clipped at 1");
    return result;
  }
}

std::optional<ProbabilityResult> intervalOfRootBound(const PlacedPair& pair,
                                                     const GaussianDisplacement& displacement,
                                                     const ProbabilityRequest& request) {
  Budget limits(request, kShareOfRootBound);
  const double upper = rootBound(pair, displacement, limits);
  const auto status = satisfied({0.0, upper}, request);
  const bool cancelled = limits.stopped() == ProbabilityStatus::cancelled;
  if (!status && !cancelled) return std::nullopt;
  ProbabilityResult result = boundedBy(upper, request);
  result.method = ProbabilityMethod::interval;
  result.lower = 0.0;
  result.status = status.value_or(ProbabilityStatus::cancelled);
  result.statistics.pairs_tested = 1;
  result.plan.push_back(status
                            ? "far apart: stopped at the bound of the root volumes, trees left out"
                            : "cancelled at the bound of the root volumes");
  return result;
}

}  // namespace fcl_prob::detail
