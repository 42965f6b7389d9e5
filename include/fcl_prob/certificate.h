// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// An interval that somebody else can check.
#pragma once

#include <fcl/narrowphase/collision_object.h>

#include <iosfwd>
#include <vector>

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob {

/// The probability that any member of A, displaced by `displacement` relative to B (world frame,
/// metres), collides with any member of B, as a certified interval; and all that is needed to check
/// that interval without this library: the objects as exact numbers, what is claimed of which
/// displacements, and what proves it. verify/FORMAT.md says how it is written, `fcl_prob_verify`
/// checks it.
///
/// Members are meshes (as surfaces, or as solids where the request says so), Boxes, Convexes,
/// TrianglePs, Spheres, Capsules and OcTrees, a cell of which is written as the box that it is in
/// doubles. Everything is proven by boxes of the displacement space, on one thread: what other
/// queries use besides (exact masses, bounds by root volumes, polytope cells) is left out, so that
/// this takes longer than they do. The certificate is one of what is known where a limit ends the
/// query, too.
///
/// \param certificate  JSON Lines; what is left in it after an exception is of no use
/// \param result       assigned only on success
/// \throws UnsupportedGeometry naming a member that no certificate can be written of;
///         InvalidRequest for methods other than automatic and interval, for bands, gradients, and
///         for displacements along an axis that does not move A or moves it less than positions are
///         rounded by; InvalidPose, InvalidGeometry, OpenMesh
double certifiedProbability(const std::vector<const fcl::CollisionObjectd*>& group_a,
                            const std::vector<const fcl::CollisionObjectd*>& group_b,
                            const GaussianDisplacement& displacement,
                            const ProbabilityRequest& request, std::ostream& certificate,
                            ProbabilityResult& result);

}  // namespace fcl_prob
