// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// An organised cloud as what it is: a depth image.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "fcl_prob/point_cloud.h"
#include "fcl_prob/sensor_model.h"

namespace fcl_prob::detail {

/// Depths along the rays of a sensor, by inverse depth, in which planes are linear over pixels.
struct DepthGrid {
  int width = 0;
  int height = 0;
  Eigen::Isometry3d sensor = Eigen::Isometry3d::Identity();
  std::vector<Eigen::Vector3d> rays;  ///< of depth 1, sensor frame
  std::vector<double> inverse;        ///< 1 / depth; 0: nothing there
  std::vector<double> deviation;      ///< of the depth, metres: standard deviation of this pixel
  std::vector<double> incidence;      ///< radians
  std::vector<int> region;            ///< of the surface; -1 without
  double pitch = 0.0;                 ///< distance of neighbouring pixels at depth 1

  int at(int u, int v) const { return v * width + u; }
  bool has(int u, int v) const {
    return u >= 0 && v >= 0 && u < width && v < height && inverse[at(u, v)] > 0.0;
  }
  std::size_t size() const { return inverse.size(); }

  /// In the frame of the points.
  Eigen::Vector3d point(int pixel) const {
    return sensor * Eigen::Vector3d(rays[pixel] / inverse[pixel]);
  }

  /// Whether two neighbours, or pixels `apart` pixels from each other, lie on one surface.
  bool connected(int p, int q, int apart = 1) const;
};

/// Pixels for which `keep` is 0 are left out. \throws InvalidGeometry if the points do not lie on
/// rays from the sensor's place, as those of an image do
DepthGrid depthGrid(const PointCloud& cloud, const std::vector<std::uint8_t>& keep);

/// Incidence and deviation of every pixel. Laterally wrong is wrong in depth where it slopes.
void judgeNoise(const SensorModel& sensor, DepthGrid& grid);

/// Averages every pixel with those up to `window` away on the same surface (a plane through them,
/// in inverse depth) and lowers its deviation accordingly. \returns pixels that go into one average
double average(int window, DepthGrid& grid);

/// Connected surfaces; those of fewer pixels than `least` are left out. \returns their sizes
std::vector<std::size_t> findRegions(std::size_t least, DepthGrid& grid);

/// The widest hole in a surface, metres: pixels without depth that do not reach the image's border.
double largestHole(const DepthGrid& grid);

/// The surfaces grown by `margin` pixels, at the depth of the nearest; with `fill` holes in them,
/// too, at the least depth around.
DepthGrid grown(const DepthGrid& grid, int margin, bool fill);

}  // namespace fcl_prob::detail
