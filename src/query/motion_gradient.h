// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// From requests for gradients to lines, and back.
#pragma once

#include "fcl_prob/motion_gradient.h"
#include "partition/motion_flux.h"

namespace fcl_prob::detail {

/// \throws InvalidRequest
void validateVelocities(const MemberVelocities& velocities, std::size_t members);
void validateGradient(const MotionGradientRequest& request);

/// Its clock runs from here on.
LineDraws drawsOf(const MotionGradientRequest& request);

MotionGradient gradientFrom(const MeanAndError& flux);

/// Where nothing can touch.
MotionGradient withoutGradient(Eigen::Index parameters);

}  // namespace fcl_prob::detail
