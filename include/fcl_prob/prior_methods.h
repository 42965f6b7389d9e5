// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The methods that the paper compares with: spheres, and enlargement by a confidence ellipsoid.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Core>
#include <cstddef>

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/general_pcd.h"
#include "fcl_prob/sphere_bv.h"

namespace fcl_prob {

/// A ball in the frame of its geometry, metres.
struct BoundingSphere {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0.0;
};

/// A ball around a mesh or a bounded convex shape, rounded outwards; within about 2 % of the
/// smallest for meshes and polytopes. \throws InvalidGeometry; UnsupportedGeometry if it is
/// unbounded
BoundingSphere boundingSphere(const fcl::CollisionGeometryd& geometry);

/// Du Toit and Burdick 2011: the density of the displacement at the middle of the C-obstacle of two
/// balls, times its volume. An approximation for balls much smaller than the displacement: it can
/// be above P or below it, and above 1. All methods by density need a displacement of rank 3.
/// \throws InvalidDistribution if the rank is less; InvalidPose, InvalidGeometry
double duToitBurdick(const BoundingSphere& a, const fcl::Transform3d& pose_a,
                     const BoundingSphere& b, const fcl::Transform3d& pose_b,
                     const GaussianDisplacement& displacement);

/// Park et al. 2016: the largest density in that C-obstacle, times its volume. At least P on every
/// input (rounding included), and may exceed 1.
///
/// The Lagrange multiplier λ of the point of largest density is found by bisection, but nothing
/// rests on its convergence: for every λ >= 0 the Lagrangian's minimum is a lower bound on the
/// squared Mahalanobis distance of the ball (weak duality), and that is what is used.
/// \throws InvalidDistribution if the rank is below 3; InvalidPose, InvalidGeometry
double parkBound(const BoundingSphere& a, const fcl::Transform3d& pose_a, const BoundingSphere& b,
                 const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement);

/// GeneralPCD over two trees of spheres with Park's bound (clipped at 1) for every pair: how the
/// method is used for meshes. leaf_bound is not looked at.
/// \throws InvalidDistribution if the rank is below 3, and as generalPcd()
GeneralPcdResult parkSum(const fcl::BVHModel<SphereBv>& a, const fcl::Transform3d& pose_a,
                         const fcl::BVHModel<SphereBv>& b, const fcl::Transform3d& pose_b,
                         const GaussianDisplacement& displacement,
                         const GeneralPcdRequest& request = {});

/// The sum of duToitBurdick() over the pairs at which that traversal ends (it refines a pair while
/// Park's bound is at least 1 - confidence): an approximation that bounds nothing, counts pairs
/// that collide together one by one, and may be far above 1. Of the request, confidence and
/// max_pairs count. \throws as parkSum()
double duToitBurdickSum(const fcl::BVHModel<SphereBv>& a, const fcl::Transform3d& pose_a,
                        const fcl::BVHModel<SphereBv>& b, const fcl::Transform3d& pose_b,
                        const GaussianDisplacement& displacement,
                        const GeneralPcdRequest& request = {});

struct EnlargedCollision {
  /// Whether A, swept by all displacements of the confidence ellipsoid, touches B. Not certain when
  /// true: rounding counts as contact.
  bool collides = true;

  /// At least P (surface meaning, as fcl::collide): 1 - confidence if nothing collides, else 1.
  double upper = 1.0;

  std::size_t pairs_tested = 0;
};

/// Enlargement by a confidence ellipsoid (Bry and Roy 2011; the "shadow" or sigma hull): A is swept
/// by the ellipsoid that holds the displacement with probability `confidence`, and tested against B
/// once. Two meshes or bounded convex shapes in any combination; depth first over both trees,
/// nearer pairs first, until a pair of leaves collides.
/// \throws InvalidRequest if confidence is not in (0, 1); InvalidDistribution if the rank is below
/// 3; InvalidGeometry, UnsupportedGeometry, InvalidPose before any work
EnlargedCollision enlargedCollision(const fcl::CollisionGeometryd& a,
                                    const fcl::Transform3d& pose_a,
                                    const fcl::CollisionGeometryd& b,
                                    const fcl::Transform3d& pose_b,
                                    const GaussianDisplacement& displacement,
                                    double confidence = 0.95);

}  // namespace fcl_prob
