// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/union_of_pairs.h"

#include <algorithm>
#include <array>
#include <memory>

#include "base/agreed_bounds.h"
#include "base/budget.h"
#include "base/constants.h"
#include "base/decision.h"
#include "bounds/convex_bound.h"
#include "convex/pair_obstacle.h"
#include "exact/convex_pair_mass.h"
#include "exact/polytope_pair.h"
#include "fcl_prob/combined_bounds.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob::detail {
namespace {

/// More pairs are for the partition, and so are more than this whose masses would be needed.
constexpr std::size_t kMostPairs = 64;
constexpr std::size_t kMostMasses = 16;

/// Of the tolerance, for what counts with its bound; and for what pairs may have in common.
constexpr double kShareOfBounds = 0.25;
constexpr double kShareOfOverlaps = 0.5;

/// More than what masses, and unit vectors that are orthogonal, are rounded by.
constexpr double kOverlapRounding = 1e-9;

/// Shorter differences of unit vectors tell no direction.
constexpr double kShortest = 1e-6;

/// A pair of members with its C-obstacle.
struct MemberPair {
  const ConvexBody &a, &b;
  const fcl::Transform3d &pose_a, &pose_b;
  double bound;
  Eigen::Vector3d direction;  ///< towards the C-obstacle, whitened
};

Eigen::Vector3d unitOr(const Eigen::Vector3d& vector, const Eigen::Vector3d& other) {
  return vector.norm() > kShortest ? vector.normalized() : other;
}

class OverlapBound {
 public:
  OverlapBound(const MemberPair& pair, const GaussianDisplacement& displacement)
      : frame_(pairFrame(pair.a, pair.pose_a, pair.b, pair.pose_b, displacement)),
        obstacle_(frame_, pair.a.set(), pair.b.set()),
        direction_(pair.direction),
        bound_(pair.bound) {}
  OverlapBound(const OverlapBound&) = delete;
  OverlapBound& operator=(const OverlapBound&) = delete;

  /// Of what both hold: within three intervals, across and along the way from one to the other.
  double commonWith(const OverlapBound& other) const {
    const double least = std::min(bound_, other.bound_);
    if (frame_.rank < 3 || !frame_.fits || !other.frame_.fits) return least;
    const Eigen::Vector3d along = unitOr(direction_ - other.direction_, Eigen::Vector3d::UnitX());
    Eigen::Vector3d across = direction_ + other.direction_;
    across = unitOr(across - along * along.dot(across), along.unitOrthogonal());
    across = (across - along * along.dot(across)).normalized();
    double mass = 1.0;
    for (const Eigen::Vector3d& side : {along, across, Eigen::Vector3d(along.cross(across))}) {
      const double upper = std::min(obstacle_->support(side), other.obstacle_->support(side));
      const double lower = -std::min(obstacle_->support(-side), other.obstacle_->support(-side));
      if (lower > upper) return 0.0;
      mass *= normalIntervalMass(lower, upper);
    }
    return std::min(least, mass * (1.0 + kOverlapRounding) + kUnderflow);
  }

 private:
  PairFrame frame_;
  PairObstacle obstacle_;
  Eigen::Vector3d direction_;
  double bound_;
};

class UnionOfPairs {
 public:
  UnionOfPairs(const GaussianDisplacement& displacement, const ProbabilityRequest& request)
      : displacement_(displacement), request_(request), limits_(request) {}

  void add(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
           const fcl::Transform3d& pose_b) {
    const ConvexPcdBounds bounds =
        convexPcd(a, pose_a, b, pose_b, displacement_, limits_.interruption());
    pairs_.push_back({a, b, pose_a, pose_b, bounds.least, bounds.direction});
  }

  std::optional<ProbabilityResult> answer() {
    std::vector<const MemberPair*> sorted;
    for (const MemberPair& pair : pairs_) sorted.push_back(&pair);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const MemberPair* p, const MemberPair* q) { return p->bound > q->bound; });
    double most = 0.0;
    for (const MemberPair* pair : sorted) most += pair->bound;
    const double allowed = kShareOfOverlaps * request_.toleranceAt(std::min(most, 1.0));
    // Bounds are no less than masses: at least those pairs weigh something.
    std::size_t count = howManyWeigh(sorted, request_.toleranceAt(sorted.front()->bound));
    if (count > kMostMasses || commonMass(sorted, count) > allowed) return std::nullopt;
    std::vector<Bounds> masses{massOf(*sorted.front())};
    count = howManyWeigh(sorted, request_.toleranceAt(masses.front().lower));
    if (count > kMostMasses) return std::nullopt;
    const double common = commonMass(sorted, count);
    if (common > allowed) return std::nullopt;
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      masses.push_back(i < count ? massOf(*sorted[i]) : Bounds{0.0, sorted[i]->bound});
    }
    if (limits_.stopped()) return std::nullopt;
    return resultOf(masses, count, common);
  }

 private:
  Bounds massOf(const MemberPair& pair) {
    Bounds known{0.0, pair.bound};
    if (displacement_.rank() == 3 && pair.a.isPolytope() && pair.b.isPolytope()) {
      const auto mass = polytopePairMass(pair.a, pair.pose_a, pair.b, pair.pose_b, displacement_,
                                         false, limits_.interruption());
      if (mass) return agreed(known, mass->mass);
    }
    return agreed(known, convexPairMass(pair.a, pair.pose_a, pair.b, pair.pose_b, displacement_,
                                        limits_.interruption()));
  }

  /// All others together are within a share of the tolerance.
  static std::size_t howManyWeigh(const std::vector<const MemberPair*>& sorted, double tolerance) {
    std::size_t count = sorted.size();
    double rest = 0.0;
    while (count > 1 && rest + sorted[count - 1]->bound <= kShareOfBounds * tolerance) {
      rest += sorted[--count]->bound;
    }
    return count;
  }

  /// Σ P_ij of those that weigh anything.
  double commonMass(const std::vector<const MemberPair*>& sorted, std::size_t count) const {
    std::vector<std::unique_ptr<const OverlapBound>> overlaps;
    double common = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      overlaps.push_back(std::make_unique<const OverlapBound>(*sorted[i], displacement_));
      for (std::size_t j = 0; j < i; ++j) common += overlaps[i]->commonWith(*overlaps[j]);
    }
    return common;
  }

  std::optional<ProbabilityResult> resultOf(const std::vector<Bounds>& masses, std::size_t count,
                                            double common) const {
    Bounds any = anyOf(masses);
    double sum = 0.0;
    for (const Bounds& mass : masses) sum += mass.lower;
    const double rounding = 4.0 * kEpsilon * static_cast<double>(kMostPairs);
    any.lower = std::max(any.lower, sum * (1.0 - rounding) - common * (1.0 + rounding));
    if (any.width() > request_.toleranceAt(any.upper)) return std::nullopt;
    ProbabilityResult result;
    result.method = ProbabilityMethod::interval;
    result.lower = any.lower;
    result.upper = any.upper;
    result.status = ProbabilityStatus::converged;
    result.decision = decisionOf(any, request_);
    result.statistics.leaf_pairs = count;
    result.plan.push_back("pairs of convex members that hardly overlap: the sum of their masses (" +
                          std::to_string(count) + " of " + std::to_string(masses.size()) +
                          " pairs)");
    return result;
  }

  const GaussianDisplacement& displacement_;
  const ProbabilityRequest& request_;
  Budget limits_;
  std::vector<MemberPair> pairs_;
};

}  // namespace

std::optional<ProbabilityResult> unionOfPairs(const MemberGroup& a,
                                              const std::vector<fcl::Transform3d>& poses_a,
                                              const MemberGroup& b,
                                              const std::vector<fcl::Transform3d>& poses_b,
                                              const GaussianDisplacement& displacement,
                                              const ProbabilityRequest& request) {
  const bool wanted = !request.gradient && !request.threshold && displacement.rank() > 0 &&
                      request.method != ProbabilityMethod::estimate;
  if (!wanted || a.bounded().size() * b.bounded().size() > kMostPairs) return std::nullopt;
  if (!a.areConvex() || !b.areConvex()) return std::nullopt;
  UnionOfPairs pairs(displacement, request);
  for (const std::size_t i : a.bounded()) {
    for (const std::size_t j : b.bounded()) {
      pairs.add(a.members()[i]->rootBody(), poses_a[i], b.members()[j]->rootBody(), poses_b[j]);
    }
  }
  return pairs.answer();
}

}  // namespace fcl_prob::detail
