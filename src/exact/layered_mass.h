// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Masses under very flat displacements, from those of sections.
#pragma once

#include <functional>

#include "base/interruption.h"
#include "fcl_prob/bounds.h"
#include "fcl_prob/convex_body.h"
#include "fcl_prob/gaussian_displacement.h"

namespace fcl_prob::detail {

/// Whether the least deviation is so much smaller than the largest that layeredMass() is worth it.
bool isFlat(const GaussianDisplacement& displacement);

/// The certified mass of a pair, given the place along one axis, where nothing moves along it.
using SectionMass =
    std::function<Bounds(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                         const GaussianDisplacement& displacement)>;

/// When to stop: at this width next to the mass, and at so many sections.
struct LayeredEffort {
  double width;
  int most_sections;
};

/// By the masses of sections across the axis of the least deviation: of a convex body their log is
/// concave along it (Prékopa), and in a flat displacement nearly straight, so that a few are
/// enough. What three of them tell, or {0, 1}, where more than the effort would be asked for: the
/// body ends there, or turns towards that axis.
Bounds layeredMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                   const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                   const SectionMass& section_mass, const LayeredEffort& effort);

}  // namespace fcl_prob::detail
