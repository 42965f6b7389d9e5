// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Whether a ray crosses a triangle, for certain.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace fcl_prob::detail {

/// How the ray from the origin in the positive direction of `axis` crosses a triangle: 0 not at
/// all, +1 in the direction of its normal, -1 against it. Nothing if moving each coordinate of the
/// corners by up to `margin` could change the answer.
std::optional<int> rayCrossing(const std::array<Eigen::Vector3d, 3>& corners, int axis,
                               double margin);

}  // namespace fcl_prob::detail
