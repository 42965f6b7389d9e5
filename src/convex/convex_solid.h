// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A closed mesh that is convex to rounding, as a polytope.
#pragma once

#include <memory>
#include <string>

#include "fcl_prob/convex_body.h"
#include "geometry/mesh_visitor.h"

namespace fcl_prob::detail {

/// The hull of a mesh, which has no triangle in its core: a convex body within, around which the
/// mesh winds, and no point of the hull's surface is farther from it than `inset` (metres). The
/// mesh is one connected surface, so that it meets another such mesh if the cores meet and no core
/// is within the other hull, and does not if the hulls do not meet or one hull is within the other
/// core (docs/rounding.md).
struct ConvexSolid {
  ConvexBody hull;
  double inset = 0.0;
};

/// Null if the mesh is not closed, not convex to a few ε of its size, or has more triangles and
/// faces than are looked at.
std::unique_ptr<const ConvexSolid> convexSolidOf(const MeshView& view, const std::string& name);

}  // namespace fcl_prob::detail
