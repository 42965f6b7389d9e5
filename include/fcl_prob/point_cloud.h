// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Point clouds from files. In the library fcl_prob::cloud.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <string>
#include <vector>

namespace fcl_prob {

struct PointCloud {
  std::size_t width = 0;
  std::size_t height = 1;  ///< above 1: organised, row by row as the sensor's image

  /// Metres; width · height of them. Not a number where the sensor saw nothing.
  std::vector<Eigen::Vector3d> points;

  /// The sensor's pose in the frame of the points; its optical axis is z, or -z.
  Eigen::Isometry3d sensor = Eigen::Isometry3d::Identity();

  bool isOrganised() const { return height > 1; }
};

/// What one cloud may use. Exceeding any of them is a FileError.
struct CloudLimits {
  std::size_t file_bytes = std::size_t{1} << 30;
  std::size_t points = std::size_t{1} << 25;
};

/// Reads a .pcd (ascii, binary, binary_compressed) or .ply file. What the header claims is held
/// against what the file has before any memory is asked for.
/// \throws FileError (missing, unreadable, truncated, not of this format), InvalidGeometry (no
///         point of it is finite); the message begins with `path`.
PointCloud loadPointCloud(const std::string& path, const CloudLimits& limits = {});

}  // namespace fcl_prob
