// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Superquadrics as convex polytopes.
#pragma once

#include <fcl/geometry/shape/convex.h>

#include <Eigen/Core>
#include <memory>

namespace fcl_prob::cli {

/// The hull of 16 times 32 points of a superquadric about the origin (Barr 1981).
/// \param semi_axes  metres
/// \param north      exponent of the latitude, in (0, 2], where it is convex: 1 is an ellipsoid,
///                   small ones are boxes, 2 is an octahedron
/// \param east       the same of the longitude
std::shared_ptr<const fcl::Convexd> superquadricHull(const Eigen::Vector3d& semi_axes, double north,
                                                     double east);

}  // namespace fcl_prob::cli
