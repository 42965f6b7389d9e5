// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Masses of pairs of solids that are convex to rounding.
#pragma once

#include "base/interruption.h"
#include "convex/convex_solid.h"
#include "fcl_prob/bounds.h"
#include "fcl_prob/gaussian_displacement.h"

namespace fcl_prob::detail {

/// A solid with its pose in the world frame.
struct PlacedSolid {
  const ConvexSolid& solid;
  const fcl::Transform3d& pose;
};

/// What of the displacements of A makes the solids meet.
Bounds solidPairMass(const PlacedSolid& a, const PlacedSolid& b,
                     const GaussianDisplacement& displacement, const Interruption& interruption);

/// What of them brings all of one solid into the other one.
enum class Guest { a, b };
Bounds containedMass(Guest guest, const PlacedSolid& a, const PlacedSolid& b,
                     const GaussianDisplacement& displacement, const Interruption& interruption);

}  // namespace fcl_prob::detail
