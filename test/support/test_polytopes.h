// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Polytopes for tests, made without the library's convex hull.
#pragma once

#include <Eigen/Core>

#include "fcl_prob/convex_polytope.h"

namespace fcl_prob_test {

/// The box [lo, hi], turned by `rotation` about the origin.
fcl_prob::ConvexPolytope boxPolytope(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi,
                                     const Eigen::Matrix3d& rotation = Eigen::Matrix3d::Identity());

/// The tetrahedron of four points in either orientation.
fcl_prob::ConvexPolytope simplexPolytope(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                         const Eigen::Vector3d& c, const Eigen::Vector3d& d);

/// Vertices moved, normals and offsets recomputed from the faces.
fcl_prob::ConvexPolytope withVertices(const fcl_prob::ConvexPolytope& polytope,
                                      const std::vector<Eigen::Vector3d>& vertices);

/// Largest distance of a vertex from the origin.
double reach(const fcl_prob::ConvexPolytope& polytope);

}  // namespace fcl_prob_test
