// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Bounds from both sides on the probability that any of some convex bodies touches any of others.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "fcl_prob/bounds.h"
#include "fcl_prob/convex_body.h"
#include "fcl_prob/convex_parts.h"
#include "fcl_prob/gaussian_displacement.h"

namespace fcl_prob {

struct PartsBoundsRequest {
  /// What all pairs together may add to the upper bound whose masses are not computed, at least 0.
  double negligible = 1e-9;

  /// Asked at every pair; once it returns true (for good), pairs count with what is known of them.
  /// Empty: never.
  std::function<bool()> interruption;
};

struct PartsBoundsResult {
  /// Contains the probability that any part of A touches any part of B. Where parts only cover two
  /// meshes, no more than `upper` is said of the meshes.
  Bounds any{0.0, 1.0};

  double sum = 0.0;      ///< of the masses of all pairs, from above: their expected number
  double largest = 0.0;  ///< mass of the heaviest pair, from above

  std::size_t pairs = 0;          ///< whose masses were computed
  std::size_t intersections = 0;  ///< of two pairs, whose masses were computed

  bool complete = true;  ///< false if the interruption ended it
};

/// Sums of masses of convex pairs, corrected for what is counted twice: from above by Hunter's
/// bound Σ P_i − Σ_{(i,j) in T} P_ij, with T a spanning tree that is about the heaviest (Hunter
/// 1976); from below by Bonferroni's Σ_S P_i − Σ_S P_ij over a set S of pairs that overlap little,
/// and by the heaviest pair. C-obstacles of convex pairs and their intersections are convex
/// polytopes, so that all masses are certified. T and S are chosen by sampling, and any choice is
/// valid.
///
/// Intersections are left out (T and S have single pairs only) for curved bodies and for
/// displacements of rank below 3.
/// \throws InvalidPose; InvalidGeometry if there are no bodies; InvalidRequest
PartsBoundsResult partsBounds(const std::vector<ConvexBody>& a, const fcl::Transform3d& pose_a,
                              const std::vector<ConvexBody>& b, const fcl::Transform3d& pose_b,
                              const GaussianDisplacement& displacement,
                              const PartsBoundsRequest& request = {});

/// The same for the parts of two meshes.
PartsBoundsResult partsBounds(const ConvexParts& a, const fcl::Transform3d& pose_a,
                              const ConvexParts& b, const fcl::Transform3d& pose_b,
                              const GaussianDisplacement& displacement,
                              const PartsBoundsRequest& request = {});

}  // namespace fcl_prob
