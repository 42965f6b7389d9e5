// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Checking the faces that the user of fcl::Convex supplies.
#pragma once

#include <fcl/geometry/shape/convex.h>

#include <string>
#include <vector>

namespace fcl_prob::detail {

/// The faces of a Convex as one list of vertex indices each.
/// \throws InvalidGeometry if the encoding [n, i0, ..., n, i0, ...] does not fit the number of
/// faces or
///         refers to a vertex that is not there.
std::vector<std::vector<int>> decodeFaces(const fcl::Convexd& convex, const std::string& name);

/// Checks what fcl::Convex trusts its user with: finite vertices that are all used, faces that
/// close a surface, planar and convex across every edge to 1e-6 of the size of the body. Linear in
/// its size. \throws InvalidGeometry
void validateConvex(const fcl::Convexd& convex, const std::string& name);

}  // namespace fcl_prob::detail
