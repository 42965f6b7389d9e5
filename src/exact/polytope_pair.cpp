// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/polytope_pair.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/agreed_bounds.h"
#include "base/constants.h"
#include "base/left_out.h"
#include "mass/long_whitening.h"
#include "mass/polytope_effort.h"
#include "mass/shell_reach.h"
#include "mass/world_pair.h"

namespace fcl_prob::detail {
namespace {

/// By what share the body may reach farther out than the faces found, and its mass be larger than
/// theirs.
constexpr double kMostBeyond = 1e-2, kMostGrowth = 0.5;

/// What may be between the mass of the C-obstacle and that of the faces found: a share of it, and
/// what they go around once more or less.
struct Growth {
  double share, folds;
};

LongVector3 middleOf(const LongPolytope& body) {
  LongVector3 sum = LongVector3::Zero();
  for (const LongVector3& v : body.vertices) sum += v;
  return sum / static_cast<long double>(body.vertices.size());
}

class PolytopePair {
 public:
  PolytopePair(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
               const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
               double inset)
      : a_(a),
        b_(b),
        frame_(pairFrame(a, pose_a, b, pose_b, displacement)),
        pair_(worldPair(frame_, a, pose_a, b, pose_b, displacement, inset)) {
    whitening_ = longWhitening(displacement);
  }

  std::optional<PairMass> answer(bool with_gradient, const Interruption& interruption) {
    if (!frame_.fits || frame_.rank < 3) return std::nullopt;
    const auto summed = summedFaces(frame_, a_, b_, interruption);
    if (!summed || summed->faces.faceCount() < 4) return std::nullopt;
    const LongPolytope body = whitened(*summed);
    const HeavyPart heavy = heavyPart(body);
    const auto growth = growthOf(body, middleOf(heavy.polytope));
    if (!growth) return std::nullopt;
    PairMass result;
    result.mass = polytopeMass(heavy, rounding(), {0.0, interruption});
    // Off the lower bound, too, for the folds; and the middle stays the best value.
    const double between =
        (growth->share * result.mass.upper + growth->folds) * (1.0 + 4.0 * kEpsilon);
    result.mass.lower = std::max(0.0, result.mass.lower - between);
    result.mass.upper = std::min(1.0, result.mass.upper + between);
    if (!with_gradient) return result;
    VectorBounds moment = withinBody(polytopeMoment(heavy, rounding()), body, result.mass);
    // Beyond, no mass can be told from nothing.
    moment.lower.array() -= kOutermostMoment * between;
    moment.upper.array() += kOutermostMoment * between;
    result.gradient = gradientOf(moment, whitening_.cast<double>());
    return result;
  }

 private:
  LongPolytope whitened(const SummedFaces& summed) const {
    LongPolytope body;
    for (const LongVector3& corner : summed.corners) {
      body.vertices.push_back(whitening_ * (corner + pair_.origin));
    }
    for (std::size_t f = 0; f < summed.faces.faceCount(); ++f) {
      std::vector<int> loop;
      for (int k = 0; k < summed.faces.cornerCount(f); ++k) {
        loop.push_back(summed.faces.corner(f, k));
      }
      body.faces.push_back({LongVector3::UnitX(), std::move(loop)});
    }
    body.findNormals();
    return body;
  }

  /// Of a small body, of whose faces little is left, the mean is known from where its corners are:
  /// that of what the faces enclose.
  VectorBounds withinBody(const VectorBounds& moment, const LongPolytope& body,
                          const Bounds& mass) const {
    const Eigen::Vector3d beyond = 2.0 * rounding();
    VectorBounds result = moment;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax_element(
          body.vertices.begin(), body.vertices.end(),
          [k](const LongVector3& v, const LongVector3& w) { return v[k] < w[k]; });
      const double lo = static_cast<double>((*low)[k]), hi = static_cast<double>((*high)[k]);
      const double error = beyond[k] + kEpsilon * std::max(std::abs(lo), std::abs(hi));
      const double least = (lo - error) * (lo < error ? mass.upper : mass.lower);
      const double most = (hi + error) * (hi > -error ? mass.upper : mass.lower);
      const double rounded = 4.0 * kEpsilon * std::max(std::abs(least), std::abs(most));
      const Bounds both = agreed({moment.lower[k], moment.upper[k]},
                                 {least - rounded - kUnderflow, most + rounded + kUnderflow});
      result.lower[k] = both.lower;
      result.upper[k] = both.upper;
    }
    return result;
  }

  /// Of a corner in the whitened frame, along each axis.
  Eigen::Vector3d rounding() const { return whitenedLength(pair_.rounding); }

  /// By how much a length can change each whitened coordinate.
  Eigen::Vector3d whitenedLength(double metres) const {
    return (1.0 + kEpsilon) * metres * whitening_.rowwise().norm().cast<double>();
  }

  /// All corners found are sums of corners, so that the surface S through them is within V. What
  /// is within c + λ(V - c) weighs at least λ³ exp(-(1 - λ) s) of V, where s is |c|²/2, |·|² being
  /// convex, or |c| times the largest |y - c|.
  std::optional<Growth> growthOf(const LongPolytope& body, const LongVector3& middle) const {
    ShellReach reach(body, middle, 2.0 * rounding() + whitenedLength(pair_.slack));
    const auto beyond = reach.share(
        {whitenedPoints(pair_.of_b), whitenedPoints(pair_.minus_a), whitening_ * pair_.origin});
    if (!beyond) return std::nullopt;
    long double farthest = 0.0L;
    for (const LongVector3& v : body.vertices) farthest = std::max(farthest, (v - middle).norm());
    const double distance = static_cast<double>(middle.norm());
    const double slope =
        distance * std::min(0.5 * distance, static_cast<double>(farthest) * (1.0 + 2.0 * *beyond));
    const double share = 1.01 * std::expm1(*beyond * (3.0 + slope));
    if (!(*beyond < kMostBeyond && share < kMostGrowth)) return std::nullopt;
    return Growth{share, reach.foldMass(*beyond)};
  }

  LongPoints whitenedPoints(const LongPoints& points) const {
    LongPoints result;
    for (const LongVector3& p : points) result.push_back(whitening_ * p);
    return result;
  }

  const ConvexBody &a_, &b_;
  PairFrame frame_;
  WorldPair pair_;
  LongMatrix3 whitening_;
};

}  // namespace

std::optional<PairMass> polytopePairMass(const ConvexBody& a, const fcl::Transform3d& pose_a,
                                         const ConvexBody& b, const fcl::Transform3d& pose_b,
                                         const GaussianDisplacement& displacement,
                                         bool with_gradient, const Interruption& interruption,
                                         double inset) {
  if (isLeftOut("long double")) return std::nullopt;
  return PolytopePair(a, pose_a, b, pose_b, displacement, inset)
      .answer(with_gradient, interruption);
}

}  // namespace fcl_prob::detail
