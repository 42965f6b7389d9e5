// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where two objects touch, if they do.
#pragma once

#include "fcl_prob/gaussian_displacement.h"
#include "query/prepared_geometry.h"

namespace fcl_prob::detail {

/// A point of A (world frame, metres, not displaced) around which contact is likely. Only how
/// narrow intervals are depends on it, not that they are right.
Eigen::Vector3d likelyContact(const PreparedGeometry& a, const fcl::Transform3d& pose_a,
                              const PreparedGeometry& b, const fcl::Transform3d& pose_b,
                              const GaussianDisplacement& displacement, std::uint64_t seed);

}  // namespace fcl_prob::detail
