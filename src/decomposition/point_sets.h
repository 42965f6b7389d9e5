// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Boxes around points, and their middles.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "convex/face_set.h"
#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::detail {

/// The mean of some points.
inline Eigen::Vector3d middleOf(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

/// The axis-aligned box of the vertices of a mesh.
inline FaceSet boxAround(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const fcl::Vector3d& v : mesh.vertices) box.extend(v);
  FaceSet faces;
  setToBox(box.min(), box.max(), faces);
  return faces;
}

}  // namespace fcl_prob::detail
