// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How far a mesh reaches into a convex body.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/mesh_visitor.h"
#include "partition/convex_fan.h"

namespace fcl_prob::detail {

/// The farthest that a mesh may reach into a body that is taken to be within it, as a share of the
/// body.
inline constexpr double kMostReach = 1e-5;

/// A share λ so that no triangle meets the inside of P shrunk by λ about its centre: of each there
/// is a plane between the two, with what rounding makes of it. Perhaps more than kMostReach; then
/// it means nothing else.
/// \param normals   of planes to try beside those of P
/// \param vertices  of the mesh, in the frame of the fan; those of `view` tell rounding
double reachInto(const ConvexFan& fan, const std::vector<Eigen::Vector3d>& normals,
                 const MeshView& view, const std::vector<Eigen::Vector3d>& vertices);

/// Depths no smaller than that share of P, so that what is told of P's inside is told of what the
/// mesh does not reach.
void allowReach(double reach, ConvexFan& fan);

}  // namespace fcl_prob::detail
