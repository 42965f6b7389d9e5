// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What cutting and proofs begin with.
#pragma once

#include <Eigen/Geometry>

#include "convex/face_set.h"
#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::detail {

/// The axis-aligned box of the vertices of a mesh.
inline FaceSet boxAround(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const fcl::Vector3d& v : mesh.vertices) box.extend(v);
  FaceSet faces;
  setToBox(box.min(), box.max(), faces);
  return faces;
}

}  // namespace fcl_prob::detail
