// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/convex_pair_mass.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/constants.h"
#include "base/known.h"
#include "bounds/pair_bounds.h"
#include "convex/pair_obstacle.h"
#include "convex/resolved_part.h"
#include "exact/boundary_mass.h"
#include "exact/layered_mass.h"
#include "exact/polytope_section.h"
#include "exact/section_mass.h"
#include "fcl_prob/bounds.h"
#include "fcl_prob/normal_mass.h"
#include "mass/ball_pair.h"

namespace fcl_prob {
namespace {

using detail::kEpsilon;
using detail::kUnderflow;
using detail::ResolvedPart;

/// Certified mass that a displacement has in a convex obstacle.
using MassOf = std::function<Bounds(const GaussianDisplacement&)>;

/// Of the step: the radius of a ball within the octahedron of the six places, which are where they
/// should be to a thousandth (1/√3 = 0.577).
constexpr double kWithinPlaces = 0.5;
constexpr double kOffPlace = 1e-3;

/// Of an exponential of a small number and of its product.
constexpr double kRounding = 16.0 * kEpsilon;

// A convex set that leaves out a point at a distance d (in deviations) of the mean is within a
// half-space that does, of a mass of Φ(d) <= 1/2 + 0.4 d.
Bounds massAround(const MassOf& mass_of, const ResolvedPart& resolved, double step) {
  const auto wide = GaussianDisplacement::fromStandardDeviations(Eigen::Vector3d::Constant(step),
                                                                 Eigen::Quaterniond::Identity(),
                                                                 resolved.displacement.mean());
  const bool is_within = mass_of(wide).lower > 0.5 + resolved.left_out / step;
  return {is_within ? 1.0 - kEpsilon : 0.0, 1.0};
}

/// Bounds on the mass in a convex obstacle of a displacement that also moves, along axes that were
/// left out of it, by what rounds positions. The mass of what is left is log-concave in its mean
/// (Prékopa), so that the masses at the mean and at six places `step` metres around it bound how it
/// changes within so little. Where nothing is left: 1 if more than half of a displacement of `step`
/// along all axes is in the obstacle, whose sides are then no nearer than that.
/// {0, 1} where that tells nothing: beside the obstacle, or so near to its sides.
//
// With r the radius around the mean m within which the mass M is not below `around`, and u at a
// distance d of m: u lies between m and a point at r, and m between u and the point at r on the
// other side. So M(m) (around / M(m))^(d/r) <= M(u) <= M(m) (M(m) / around)^(d/r).
Bounds massNear(const MassOf& mass_of, const ResolvedPart& resolved, double step) {
  if (resolved.displacement.rank() == 0) return massAround(mass_of, resolved, step);
  const Eigen::Vector3d& mean = resolved.displacement.mean();
  const Bounds middle = mass_of(resolved.displacement);
  double around = middle.lower;
  for (int k = 0; k < 6 && around > 0.0; ++k) {
    const Eigen::Vector3d shift = (k % 2 == 0 ? step : -step) * Eigen::Vector3d::Unit(k / 2);
    const Eigen::Vector3d place = mean + shift;
    if (!((place - mean - shift).norm() <= kOffPlace * step)) return {0.0, 1.0};
    around = std::min(around, mass_of(resolved.displacement.withMean(place)).lower);
  }
  if (!(around > 0.0)) return {0.0, 1.0};
  const double share = resolved.left_out / (kWithinPlaces * step);
  const auto growth = [&](double mass) {
    return std::exp(share * std::log(mass / around) * (1.0 + kRounding)) * (1.0 + kRounding);
  };
  // Beyond the reach there is less than the least double.
  return {middle.lower / growth(middle.lower),
          std::min(1.0, middle.upper * growth(middle.upper) + kUnderflow)};
}

/// What is aimed at by sections of flat displacements: of polytopes, of others.
constexpr double kRoundingWidth = 1e-10, kCurvedWidth = 1e-6;

/// How many of them: before quadrature over the boundary is tried, and instead of polytopes.
constexpr int kFewSections = 10, kMostSections = 40;

/// What is below cannot be told from nothing.
constexpr double kNothing = 1e-300;

/// Of the bodies' size: how far apart sections are that tell of each other. Far more than positions
/// are rounded by, and little beside a body.
constexpr double kStepOfSection = 0x1p-16;

/// Mass of a ball, of which the closed form for equal deviations is the fastest.
Bounds ballMass(const detail::PrincipalBall& ball, const GaussianDisplacement& displacement) {
  if (!displacement.isotropic()) return detail::principalBallMass(ball, displacement);
  // The deviations differ by rounding only; the mass falls with the distance and grows with the
  // radius.
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  const auto [x, y, z] = ball.centre;
  const auto distance = static_cast<double>(std::hypot(x, y, z));
  const auto radius = static_cast<double>(ball.radius);
  const double far = distance * (1.0 + kRounding) + 2.0 * ball.centre_error;
  const double near = distance * (1.0 - kRounding) - 2.0 * ball.centre_error;
  const double small = radius * (1.0 - kRounding) - ball.radius_error;
  const double large = radius * (1.0 + kRounding) + ball.radius_error;
  const double most = displacement.standardDeviations().maxCoeff();
  const double least = displacement.standardDeviations().minCoeff();
  return {normalBallMass(far / least, std::max(small, 0.0) / most).lower,
          normalBallMass(std::max(near, 0.0) / most, large / least).upper};
}

}  // namespace

Bounds detail::convexPairMass(const ConvexBody& a, const fcl::Transform3d& pose_a,
                              const ConvexBody& b, const fcl::Transform3d& pose_b,
                              const GaussianDisplacement& displacement,
                              const Interruption& interruption, double inset) {
  const double size = std::max(a.set().size(), b.set().size());
  const ResolvedPart resolved = resolvedPart(displacement, size);
  if (resolved.left_out > 0.0) {
    const auto mass_of = [&](const GaussianDisplacement& of) {
      return detail::convexPairMass(a, pose_a, b, pose_b, of, interruption, inset);
    };
    const Bounds mass = massNear(mass_of, resolved, kStepOfSection * size);
    if (mass.width() < 1.0) return mass;
  }
  const PairFrame frame = pairFrame(a, pose_a, b, pose_b, displacement);
  const PairObstacle obstacle(frame, a.set(), b.set());
  PairBounds pair;
  Bounds known{0.0, 1.0};
  const bool is_flat = isFlat(displacement);
  const auto narrowByLayers = [&](double width, int most_sections) {
    const auto section = [&](const fcl::Transform3d& at_a, const fcl::Transform3d& at_b,
                             const GaussianDisplacement& across) {
      return detail::convexPairMass(a, at_a, b, at_b, across, interruption, inset);
    };
    known = agreed(
        known, layeredMass(a, pose_a, b, pose_b, displacement, section, {width, most_sections}));
    return known.width() <= width * known.upper;
  };
  if (obstacle->isPolytope()) {
    if (frame.rank == 1 || frame.rank == 2) {
      known = polytopeSectionMass(a, pose_a, b, pose_b, displacement, interruption, inset);
      if (known.width() <= std::max(kRoundingWidth * known.upper, kNothing)) return known;
    }
    if (is_flat) narrowByLayers(kRoundingWidth, kMostSections);
    return agreed(known, pair.mass(*obstacle, {0.0, interruption}));
  }
  if (const auto ball = ballOfPair(a, pose_a, b, pose_b, displacement)) {
    known = ballMass(*ball, displacement);
    if (isNarrowMass(known)) return known;
  }
  if (is_flat && narrowByLayers(kCurvedWidth, kFewSections)) return known;
  const RoundedEffort mass_only{false, interruption};
  known = agreed(known, frame.rank == 3
                            ? boundaryMass(a, pose_a, b, pose_b, displacement, mass_only).mass
                            : sectionMass(a, pose_a, b, pose_b, displacement, interruption));
  if (isNarrowMass(known)) return known;
  if (is_flat && !isDue(interruption)) {
    narrowByLayers(kCurvedWidth, kMostSections);
    if (isNarrowMass(known)) return known;
  }
  using Faces = ConvexSetObstacle::Faces;
  const ConvexSetObstacle outer(frame, a.set(), b.set(), Faces::outer);
  const ConvexSetObstacle inner(frame, a.set(), b.set(), Faces::inner);
  const MassEffort effort{kSandwichWidth, interruption};
  return agreed(known, {pair.mass(inner, effort).lower, pair.mass(outer, effort).upper});
}

Bounds convexPairMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                      const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement) {
  return detail::convexPairMass(a, pose_a, b, pose_b, displacement, {});
}

}  // namespace fcl_prob
