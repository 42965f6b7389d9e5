// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "narrowphase/convex_pair_mass.h"

#include <algorithm>

#include "cobstacle/convex_body_data.h"
#include "fcl_prob/normal_mass.h"
#include "narrowphase/pair_bounds.h"

namespace fcl_prob {
namespace {

/// The masses of polytopes inside and around a curved body differ by about 4 / resolution.
constexpr double kSandwichWidth = 1e-4;

/// Mass of a ball whose centre is known to within `error` (metres); the deviations differ by
/// rounding only. The mass falls with the distance and grows with the radius.
Bounds ballMass(const detail::Ellipsoid& ball, double error, const Eigen::Vector3d& deviations) {
  const double distance = ball.centre.norm();
  const double most = deviations.maxCoeff();
  const double least = deviations.minCoeff();
  const double inner_radius = std::max(ball.radius - error, 0.0);
  return {
      normalBallMass((distance + error) / least, inner_radius / most).lower,
      normalBallMass(std::max(distance - error, 0.0) / most, (ball.radius + error) / least).upper};
}

}  // namespace

Bounds detail::convexPairMass(const ConvexBody& a, const fcl::Transform3d& pose_a,
                              const ConvexBody& b, const fcl::Transform3d& pose_b,
                              const GaussianDisplacement& displacement,
                              const Interruption& interruption) {
  const PairFrame frame = pairFrame(a, pose_a, b, pose_b, displacement);
  const PairObstacle obstacle(frame, a.data(), b.data());
  PairBounds pair;
  if (obstacle->isPolytope()) return pair.mass(*obstacle, {0.0, interruption});
  const auto ball = obstacle->ellipsoid();
  if (ball && displacement.isotropic()) {
    const double error = frame.error + 2.0 * frame.ball_stretch * ball->radius;
    return ballMass(*ball, error, displacement.standardDeviations());
  }
  using Faces = ConvexSetObstacle::Faces;
  const ConvexSetObstacle outer(frame, a.data().set(), b.data().set(), Faces::outer);
  const ConvexSetObstacle inner(frame, a.data().set(), b.data().set(), Faces::inner);
  const MassEffort effort{kSandwichWidth, interruption};
  return {pair.mass(inner, effort).lower, pair.mass(outer, effort).upper};
}

Bounds convexPairMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                      const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement) {
  return detail::convexPairMass(a, pose_a, b, pose_b, displacement, {});
}

}  // namespace fcl_prob
