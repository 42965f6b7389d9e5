// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/exact_mass.h"

#include <algorithm>

#include "fcl_prob/convex_pcd.h"
#include "query/single_collide.h"

namespace fcl_prob::detail {
namespace {

/// Four times the points leave a quarter of the gap, at about ten times the cost: no way to small
/// gaps.
constexpr int kFineResolution = 4 * ConvexBody::kDefaultResolution;

/// What rounding leaves of the mass of a polytope.
constexpr double kRoundingWidth = 1e-9;

class ExactMass {
 public:
  ExactMass(const PlacedPair& pair, const GaussianDisplacement& displacement,
            const ProbabilityRequest& request)
      : pair_(pair),
        displacement_(displacement),
        request_(request),
        flat_(pair.a.rootBody().isPolytope() && pair.b.rootBody().isPolytope()),
        mass_(massOf(pair.a.rootBody(), pair.b.rootBody())) {}

  ProbabilityResult answer() {
    if (status() == ProbabilityStatus::resolution_limit) refine();
    ProbabilityResult result;
    result.method = ProbabilityMethod::exact;
    result.status = status();
    result.lower = mass_.lower;
    result.upper = mass_.upper;
    result.decision = decisionOf(mass_, request_);
    result.statistics.leaf_pairs = 1;
    if (status() != ProbabilityStatus::exact) {
      result.plan.push_back("curved sides enclosed between polytopes");
    }
    return result;
  }

 private:
  Bounds massOf(const ConvexBody& a, const ConvexBody& b) const {
    return convexPairMass(a, pair_.pose_a, b, pair_.pose_b, displacement_);
  }

  void refine() {
    const Bounds finer = massOf(ConvexBody(pair_.a.geometry(), kFineResolution),
                                ConvexBody(pair_.b.geometry(), kFineResolution));
    mass_ = {std::max(mass_.lower, finer.lower), std::min(mass_.upper, finer.upper)};
  }

  ProbabilityStatus status() const {
    if (flat_ || mass_.width() <= kRoundingWidth * mass_.upper) return ProbabilityStatus::exact;
    const Decision decision = decisionOf(mass_, request_);
    if (decision == Decision::below || decision == Decision::above) {
      return ProbabilityStatus::decided;
    }
    const double tolerance =
        std::max(request_.absolute_tolerance, request_.relative_tolerance * mass_.upper);
    return mass_.width() <= tolerance ? ProbabilityStatus::converged
                                      : ProbabilityStatus::resolution_limit;
  }

  const PlacedPair& pair_;
  const GaussianDisplacement& displacement_;
  const ProbabilityRequest& request_;
  bool flat_;
  Bounds mass_;
};

}  // namespace

ProbabilityResult exactMass(const PlacedPair& pair, const GaussianDisplacement& displacement,
                            const ProbabilityRequest& request) {
  return ExactMass(pair, displacement, request).answer();
}

}  // namespace fcl_prob::detail
