// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// From a geometry to the tree of convex bodies that it is.
#pragma once

#include <memory>
#include <string>

#include "paper/bounding_tree.h"

namespace fcl_prob::detail {

/// \throws InvalidGeometry if the geometry is malformed, UnsupportedGeometry if it is neither a
/// mesh nor a bounded convex shape; the message names it and the method
void requireTree(const fcl::CollisionGeometryd& geometry, const std::string& name,
                 const std::string& method);

/// The tree of a mesh, or of one node for a convex shape. The geometry must outlive it.
std::unique_ptr<const BoundingTree> makeTree(const fcl::CollisionGeometryd& geometry);

}  // namespace fcl_prob::detail
