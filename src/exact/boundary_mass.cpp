// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/boundary_mass.h"

#include <algorithm>

#include "base/known.h"
#include "exact/curved_pair.h"
#include "exact/ellipsoid_polytope.h"
#include "exact/rounded_pair.h"
#include "mass/ball_pair.h"

namespace fcl_prob::detail {
BoundaryKind boundaryKind(const ConvexBody& a, const ConvexBody& b) {
  if (a.isPolytope() && b.isPolytope()) return BoundaryKind::flat;
  if (isBall(a) && isBall(b)) return BoundaryKind::ball;
  if (isRoundedPair(a, b)) return BoundaryKind::rounded;
  if (isEllipsoidWithPolytope(a, b)) return BoundaryKind::ellipsoid;
  return isCurvedPair(a, b) ? BoundaryKind::curved : BoundaryKind::other;
}

bool isNarrowMass(const Bounds& mass) {
  constexpr double kNothing = 1e-300;  // what is below cannot be told from it
  return mass.width() <= std::max(kSandwichWidth * mass.upper, kNothing);
}

// Balls and capsules have smooth patches, too, for where rounding spoils the faces of their sum.
PairMass boundaryMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                      const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                      const RoundedEffort& effort) {
  const BoundaryKind kind = boundaryKind(a, b);
  PairMass known;
  if (kind == BoundaryKind::ball || kind == BoundaryKind::rounded) {
    known = roundedPairMass(a, pose_a, b, pose_b, displacement, effort);
  } else if (kind == BoundaryKind::ellipsoid) {
    known = ellipsoidPolytopeMass(a, pose_a, b, pose_b, displacement, effort);
  }
  if (isNarrowMass(known.mass) || !isCurvedPair(a, b)) return known;
  PairMass curved = curvedPairMass(a, pose_a, b, pose_b, displacement, effort);
  curved.mass = agreed(known.mass, curved.mass);
  if (known.gradient) curved.gradient = known.gradient;
  return curved;
}

}  // namespace fcl_prob::detail
