// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The reference: displaced fcl::collide, counted. Confidence intervals, nothing certified.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <cstddef>

#include "fcl_prob/bounds.h"
#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/pose_error.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob {

class GaussianMixture;

/// Whether fcl::collide answers this pair. For meshes of different bounding volumes and for
/// TriangleP FCL 0.7 prints a warning and returns "no collision"; on a Convex with a Plane it
/// crashes. (It also crashes on AABB and KDOP meshes with a Halfspace or Plane, but those are
/// answered here by handing it the same triangles in a tree of OBBRSS.)
bool fclSupportsPair(const fcl::CollisionGeometryd& a, const fcl::CollisionGeometryd& b);

/// Counts how often `a`, moved by random displacements (world frame, metres), collides with `b`.
///
/// The seed fixes every sample, whatever the number of threads. Sets estimate, standard_error (with
/// half a hit added, so that it is not 0 without hits), confidence_interval (Clopper-Pearson) and,
/// if asked for and the covariance has full rank, the gradient with its standard error. Stops after
/// request.samples, or when the half-width of the interval is within the tolerance or, if there is
/// one, the threshold is outside the interval, whatever its width; both are looked at on a fixed
/// schedule (1024 samples, then doubling) whose looks share the error probability, so that stopping
/// early does not spoil the coverage. A time limit or a cancellation stops it at any time.
///
/// \throws InvalidGeometry, InvalidPose, InvalidRequest
/// \throws UnsupportedGeometry if fclSupportsPair() is false
/// \throws OpenMesh if request.contact is `solid` and a mesh is not closed
ProbabilityResult monteCarloProbability(const fcl::CollisionGeometryd& a,
                                        const fcl::Transform3d& pose_a,
                                        const fcl::CollisionGeometryd& b,
                                        const fcl::Transform3d& pose_b,
                                        const GaussianDisplacement& displacement,
                                        const ProbabilityRequest& request);

/// The same for a mixture (fcl_prob/mixture.h): every sample first draws its component, so that the
/// interval, the samples and the limits are those of the whole. The gradient, that of moving all
/// components alike, needs all of them to have full rank.
ProbabilityResult monteCarloProbability(const fcl::CollisionGeometryd& a,
                                        const fcl::Transform3d& pose_a,
                                        const fcl::CollisionGeometryd& b,
                                        const fcl::Transform3d& pose_b,
                                        const GaussianMixture& displacement,
                                        const ProbabilityRequest& request);

/// The same for an error of A's pose in all six dimensions; no gradient.
/// \throws as above
ProbabilityResult poseMonteCarloProbability(const fcl::CollisionGeometryd& a,
                                            const fcl::Transform3d& pose_a,
                                            const fcl::CollisionGeometryd& b,
                                            const fcl::Transform3d& pose_b, const PoseError& error,
                                            const ProbabilityRequest& request);

/// The same for small probabilities, by importance sampling.
///
/// Finds the nearest displacement that collides in the whitened frame (FCL's mesh distance of the
/// whitened shapes, of polyhedra around curved ones), learns from pilot runs (a fifth of
/// request.samples) where the hits are, and samples a mixture of heavy-tailed components there,
/// mixed with a shell of all directions beyond the nearest contact. The shell bounds the weight of
/// every hit, so the interval (gamma interval of Fay & Feuer 1997) holds however badly the mixture
/// fits. request.absolute_tolerance is not used. statistics.effective_samples says how many equally
/// weighted hits the hits are worth.
///
/// \throws as monteCarloProbability(); InvalidRequest also if the covariance is 0, or so small
/// beside the objects that their size in standard deviations is above 1e150.
ProbabilityResult rareEventProbability(const fcl::CollisionGeometryd& a,
                                       const fcl::Transform3d& pose_a,
                                       const fcl::CollisionGeometryd& b,
                                       const fcl::Transform3d& pose_b,
                                       const GaussianDisplacement& displacement,
                                       const ProbabilityRequest& request);

/// Exact confidence interval (Clopper & Pearson 1934) of a probability from `hits` in `samples`
/// trials: covers it with at least `confidence`, usually more. \throws InvalidRequest if samples is
/// 0, hits > samples or confidence is not in (0, 1).
Bounds clopperPearsonInterval(std::size_t hits, std::size_t samples, double confidence);

}  // namespace fcl_prob
