// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The convex hull of a few points as triangles, whatever lies in one plane.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::detail {

/// By gift wrapping, of points each of which is moved by about 1e-11 of their distances, relative
/// to the first of them: these are the vertices. The surface is closed; that all points are behind
/// its triangles is not certain. No triangles where there is none. Meant for some tens of points.
TriangleMesh hullTriangles(const std::vector<Eigen::Vector3d>& points);

}  // namespace fcl_prob::detail
