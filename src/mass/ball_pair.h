// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Pairs of balls (and points), of which the C-obstacle is a ball.
#pragma once

#include <optional>

#include "convex/convex_set.h"
#include "fcl_prob/convex_body.h"
#include "mass/principal_ball.h"

namespace fcl_prob::detail {

/// Or a point.
bool isBall(const ConvexBody& body);

/// The C-obstacle of two bodies that are balls, along the principal axes of the displacement;
/// nothing for other bodies. What rounding and matrices that are only nearly rotations make of it
/// is counted.
std::optional<PrincipalBall> ballOfPair(const ConvexBody& a, const fcl::Transform3d& pose_a,
                                        const ConvexBody& b, const fcl::Transform3d& pose_b,
                                        const GaussianDisplacement& displacement);

}  // namespace fcl_prob::detail
