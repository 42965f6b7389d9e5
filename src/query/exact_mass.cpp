// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/exact_mass.h"

#include <optional>

#include "base/budget.h"
#include "base/decision.h"
#include "base/known.h"
#include "bounds/convex_bound.h"
#include "bounds/pair_bounds.h"
#include "convex/pair_obstacle.h"
#include "exact/boundary_mass.h"
#include "exact/convex_pair_mass.h"

namespace fcl_prob::detail {
namespace {

/// Four times the points leave a quarter of the gap, at about ten times the cost: no way to small
/// gaps.
constexpr int kFineResolution = 4 * ConvexBody::kDefaultResolution;

class ExactMass {
 public:
  ExactMass(const PlacedPair& pair, const GaussianDisplacement& displacement,
            const ProbabilityRequest& request)
      : pair_(pair),
        displacement_(displacement),
        request_(request),
        limits_(request),
        flat_(pair.a.rootBody().isPolytope() && pair.b.rootBody().isPolytope()) {}

  ProbabilityResult answer() {
    if (request_.gradient) {
      if (flat_) {
        findFlatGradient();
      } else {
        findGradient();
      }
    }
    if (!isSettled()) narrow(massOf(pair_.a.rootBody(), pair_.b.rootBody()));
    if (isOpenBetweenPolytopes()) {
      narrow({0.0, boundOf(pair_.a.rootBody(), pair_.b.rootBody())});
    }
    if (isOpenBetweenPolytopes()) {
      narrow(massOf(ConvexBody(pair_.a.geometry(), kFineResolution),
                    ConvexBody(pair_.b.geometry(), kFineResolution)));
    }
    ProbabilityResult result;
    result.method = ProbabilityMethod::exact;
    result.status = status();
    result.lower = mass_.lower;
    result.upper = mass_.upper;
    result.decision = decisionOf(mass_, request_);
    result.statistics.leaf_pairs = 1;
    if (gradient_) {
      result.gradient = gradient_->middle();
      result.gradient_lower = gradient_->lower;
      result.gradient_upper = gradient_->upper;
    } else if (request_.gradient) {
      result.plan.push_back("no gradient: the interval method has one");
    }
    if (isBetweenPolytopes()) {
      result.plan.push_back("curved sides enclosed between polytopes");
    }
    return result;
  }

 private:
  Bounds massOf(const ConvexBody& a, const ConvexBody& b) {
    return detail::convexPairMass(a, pair_.pose_a, b, pair_.pose_b, displacement_,
                                  limits_.interruption());
  }

  /// Whether what is known spares the bodies as they are enclosed elsewhere.
  bool isSettled() const {
    return !flat_ && gradient_ && status() != ProbabilityStatus::resolution_limit;
  }

  void findFlatGradient() {
    const ConvexBody &a = pair_.a.rootBody(), &b = pair_.b.rootBody();
    const PairFrame frame = pairFrame(a, pair_.pose_a, b, pair_.pose_b, displacement_);
    const PairObstacle obstacle(frame, a.set(), b.set());
    PairBounds bounds;
    const auto moment = bounds.moment(*obstacle, limits_.interruption());
    if (moment) gradient_ = gradientOf(*moment, frame.whitening);
  }

  /// Of curved shapes.
  void findGradient() {
    if (displacement_.rank() < 3) return;
    const PairMass both = boundaryMass(pair_.a.rootBody(), pair_.pose_a, pair_.b.rootBody(),
                                       pair_.pose_b, displacement_, {true, limits_.interruption()});
    gradient_ = both.gradient;
    if (gradient_) narrow(both.mass);
  }

  /// By support values, where the polytope around a curved body sticks out of it.
  double boundOf(const ConvexBody& a, const ConvexBody& b) {
    return detail::convexPcd(a, pair_.pose_a, b, pair_.pose_b, displacement_,
                             limits_.interruption())
        .least;
  }

  /// No quadrature leaves that much.
  bool isBetweenPolytopes() const { return !flat_ && !isNarrowMass(mass_); }
  bool isOpenBetweenPolytopes() const {
    return status() == ProbabilityStatus::resolution_limit && isBetweenPolytopes();
  }

  void narrow(const Bounds& mass) {
    mass_ = detail::agreed(mass_, mass);
    limits_.tell(mass_, 0.5);
  }

  ProbabilityStatus status() const {
    const bool is_known = mass_.width() < 1.0;
    if ((flat_ && is_known && !limits_.stopped()) || mass_.width() <= kRoundingWidth * mass_.upper)
      return ProbabilityStatus::exact;
    if (const auto status = satisfied(mass_, request_)) return *status;
    return limits_.stopped().value_or(ProbabilityStatus::resolution_limit);
  }

  const PlacedPair& pair_;
  const GaussianDisplacement& displacement_;
  const ProbabilityRequest& request_;
  Budget limits_;
  bool flat_;
  Bounds mass_{0.0, 1.0};
  std::optional<VectorBounds> gradient_;
};

}  // namespace

ProbabilityResult exactMass(const PlacedPair& pair, const GaussianDisplacement& displacement,
                            const ProbabilityRequest& request) {
  return ExactMass(pair, displacement, request).answer();
}

}  // namespace fcl_prob::detail
