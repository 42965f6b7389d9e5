// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What PCL does here: planes, outliers, and meshes of clouds that are no image.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "fcl_prob/reconstruction.h"

namespace fcl_prob::detail {

using Points = std::vector<Eigen::Vector3d>;

/// The plane n·x = d with the most points within `tolerance`; nothing if there is none.
std::optional<Eigen::Vector4d> largestPlane(const Points& points, double tolerance);

/// 1 for points that are no farther from their neighbours than points usually are.
std::vector<std::uint8_t> inliers(const Points& points);

struct PointsMesh {
  TriangleMesh mesh;
  double spacing = 0.0;           ///< metres: median distance of neighbours
  double averaged = 1.0;          ///< points that one vertex is the average of
  std::vector<double> incidence;  ///< of the vertices
};

/// \param eye  normals turn to it
PointsMesh meshOfPoints(const Points& points, const Eigen::Vector3d& eye, PointMeshing meshing);

}  // namespace fcl_prob::detail
