// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cobstacle/convex_body_data.h"
#include "fcl_prob/convex_pcd.h"
#include "fcl_prob/normal_mass.h"
#include "narrowphase/pair_bounds.h"

namespace fcl_prob {

Bounds convexPairMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                      const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement) {
  const detail::PairFrame frame = detail::pairFrame(a, pose_a, b, pose_b, displacement);
  const detail::PairObstacle obstacle(frame, a.data(), b.data());
  detail::PairBounds pair;
  if (obstacle->isPolytope()) return pair.mass(*obstacle);
  const auto ball = obstacle->ellipsoid();
  if (ball && displacement.isotropic()) {
    const double scale = displacement.standardDeviations()[0];
    return normalBallMass(ball->centre.norm() / scale, ball->radius / scale);
  }
  using detail::ConvexSetObstacle;
  using Faces = ConvexSetObstacle::Faces;
  const ConvexSetObstacle outer(frame, a.data().set(), b.data().set(), Faces::outer);
  const ConvexSetObstacle inner(frame, a.data().set(), b.data().set(), Faces::inner);
  return {pair.mass(inner).lower, pair.mass(outer).upper};
}

}  // namespace fcl_prob
