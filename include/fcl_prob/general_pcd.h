// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Upper bounds on the collision probability of meshes by their bounding volume trees.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/collision_geometry.h>

#include <cstddef>
#include <functional>
#include <limits>

#include "fcl_prob/convex_hull_tree.h"
#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/kdop26.h"
#include "fcl_prob/sphere_bv.h"

namespace fcl_prob {

/// How the bounds of child pairs are put together.
enum class GeneralPcdVariant {
  sum,  ///< Algorithm 2 as printed: the sum over the children. Exceeds 1 by far for close meshes,
        ///< because pairs that collide together are counted one by one.
  minimum  ///< min(parent, sum over the children): never above the bound of the root volumes
};

/// What bounds a pair of leaves.
enum class LeafBound {
  volumes,   ///< their bounding volumes, as printed
  triangles  ///< the triangles themselves (a convex shape: itself), which is tighter
};

struct GeneralPcdRequest {
  /// δ of the paper, in [0, 1]: a pair whose bound is below 1 - δ is not refined. At δ = 1 all
  /// pairs are.
  double confidence = 0.99;

  /// A pair that one half-space bounds below this counts with that bound, which takes microseconds
  /// whatever the faces: the sum is larger by no more than this for each pair that is summed. At
  /// least 0; displacements of rank 3 only.
  double negligible = 0.0;

  GeneralPcdVariant variant = GeneralPcdVariant::sum;
  LeafBound leaf_bound = LeafBound::volumes;

  /// Pairs to bound at most, at least 1. Pairs that cannot be refined any more count with the bound
  /// they have, so the result stays an upper bound; 1 is the bound of the root volumes.
  std::size_t max_pairs = std::numeric_limits<std::size_t>::max();

  /// Asked at every pair; once it returns true (for good), no more pairs are refined, as if
  /// max_pairs were reached. Empty: never.
  std::function<bool()> interruption;

  /// Stop as soon as the sum exceeds 1 (variant `sum`): then raw_sum is not complete.
  bool stop_at_one = false;
};

struct GeneralPcdResult {
  double upper = 1.0;    ///< at least P on every input: raw_sum clipped at 1
  double raw_sum = 0.0;  ///< before clipping
  double root = 1.0;     ///< the bound of the root volumes

  /// False if max_pairs, the interruption or stop_at_one ended the refinement.
  bool complete = true;

  std::size_t pairs_bounded = 0;  ///< ConvexPCD evaluated
  std::size_t pairs_summed = 0;   ///< pairs whose bound entered the sum
  std::size_t leaf_pairs = 0;     ///< of these, pairs of leaves
};

/// GeneralPCD, Algorithm 2 of the paper, for two geometries that are each either a fcl::BVHModel
/// (AABB, OBB, RSS, OBBRSS, kIOS, KDOP16, 18, 24) or a bounded convex shape (a tree of one node).
/// Two meshes must have the same bounding volume. Of two nodes the one with the larger volume is
/// refined.
///
/// P is the probability of the surface meaning (what fcl::collide means). For two meshes it is an
/// upper bound of nothing else: one closed mesh inside the other collides only as a solid. \throws
/// InvalidGeometry, UnsupportedGeometry, InvalidPose, InvalidRequest before any work
GeneralPcdResult generalPcd(const fcl::CollisionGeometryd& a, const fcl::Transform3d& pose_a,
                            const fcl::CollisionGeometryd& b, const fcl::Transform3d& pose_b,
                            const GaussianDisplacement& displacement,
                            const GeneralPcdRequest& request = {});

/// The same for the bounding volumes of this library.
GeneralPcdResult generalPcd(const fcl::BVHModel<SphereBv>& a, const fcl::Transform3d& pose_a,
                            const fcl::BVHModel<SphereBv>& b, const fcl::Transform3d& pose_b,
                            const GaussianDisplacement& displacement,
                            const GeneralPcdRequest& request = {});
GeneralPcdResult generalPcd(const fcl::BVHModel<Kdop26>& a, const fcl::Transform3d& pose_a,
                            const fcl::BVHModel<Kdop26>& b, const fcl::Transform3d& pose_b,
                            const GaussianDisplacement& displacement,
                            const GeneralPcdRequest& request = {});
GeneralPcdResult generalPcd(const ConvexHullTree& a, const fcl::Transform3d& pose_a,
                            const ConvexHullTree& b, const fcl::Transform3d& pose_b,
                            const GaussianDisplacement& displacement,
                            const GeneralPcdRequest& request = {});

}  // namespace fcl_prob
