// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Meshes as solids.
#pragma once

#include "fcl_prob/triangle_mesh.h"
#include "geometry/closed_mesh.h"
#include "geometry/mesh_visitor.h"
#include "mesh_shapes.h"

namespace fcl_prob_test {

/// \throws fcl_prob::OpenMesh
inline fcl_prob::detail::ClosedMesh closedMesh(const fcl_prob::TriangleMesh& mesh) {
  return fcl_prob::detail::ClosedMesh(fcl_prob::detail::meshView(*makeModel<fcl::OBBRSSd>(mesh)),
                                      "mesh");
}

}  // namespace fcl_prob_test
