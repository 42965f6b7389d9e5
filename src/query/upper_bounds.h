// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Answers that are upper bounds only.
#pragma once

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"
#include "query/prepared_geometry.h"

namespace fcl_prob::detail {

/// A pair with its poses in the world frame.
struct PlacedPair {
  const PreparedGeometry& a;
  const fcl::Transform3d& pose_a;
  const PreparedGeometry& b;
  const fcl::Transform3d& pose_b;
};

/// The bound of two convex shapes, or of the root volumes of meshes.
ProbabilityResult convexBound(const PlacedPair& pair, const GaussianDisplacement& displacement,
                              const ProbabilityRequest& request);

/// GeneralPCD in the variant of request.method; request.max_cells limits the pairs that are
/// bounded.
ProbabilityResult generalPcdBound(const PlacedPair& pair, const GaussianDisplacement& displacement,
                                  const ProbabilityRequest& request);

/// The answer of the partition, if the root volumes alone are so unlikely to meet that [0, bound]
/// is within the tolerance or decides the threshold, or if it is cancelled before more is known.
std::optional<ProbabilityResult> intervalOfRootBound(const PlacedPair& pair,
                                                     const GaussianDisplacement& displacement,
                                                     const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
