// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Shapes as triangles to look at. Nothing is computed from them.
#pragma once

#include "cli/geometry.h"
#include "fcl_prob/gaussian_displacement.h"

namespace fcl_prob::cli {

TriangleMesh moved(TriangleMesh mesh, const fcl::Transform3d& pose);

/// Adds a moved mesh to others.
void append(const TriangleMesh& mesh, const fcl::Transform3d& pose, TriangleMesh& all);

/// The triangles of a tree of OBBRSS, the cubes of an octree, or the tessellation of a primitive,
/// in its own frame. \throws UnsupportedGeometry for anything else, unbounded primitives among it
TriangleMesh drawnGeometry(const fcl::CollisionGeometryd& geometry);

/// The object's own mesh, or a tessellation of the primitive, in the world frame.
/// \throws UnsupportedGeometry for an unbounded primitive
TriangleMesh drawnMesh(const LoadedObject& object);

/// The ellipsoid of `deviations` standard deviations around `centre`, in the world frame.
TriangleMesh drawnEllipsoid(const GaussianDisplacement& displacement, double deviations,
                            const Eigen::Vector3d& centre);

/// The point of A that is nearest to B; the middle of A if they overlap.
Eigen::Vector3d nearestPoint(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace fcl_prob::cli
