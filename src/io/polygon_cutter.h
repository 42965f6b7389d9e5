// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Triangles of polygons, convex or not.
#pragma once

#include <optional>
#include <vector>

#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::detail {

/// Cuts polygons into triangles between their own corners, by cutting off ears.
class PolygonCutter {
 public:
  /// Polygons are given by indices into `vertices`, which stay with the caller.
  explicit PolygonCutter(const std::vector<fcl::Vector3d>& vertices) : vertices_(vertices) {}

  /// Appends the n - 2 triangles of a polygon of n >= 3 corners, which turn as it does. It is seen
  /// along its mean normal, so it need not be quite plane. A convex one becomes the fan of its
  /// first corner. \returns false, having appended nothing, if the polygon crosses itself.
  bool cut(const std::vector<std::size_t>& corners, std::vector<fcl::Triangle>& triangles);

 private:
  using Point = Eigen::Vector2d;
  enum class Rule { strict, flat, touching };

  bool project(const std::vector<std::size_t>& corners);
  double noArea() const;
  bool isOnOneLine() const;
  bool clip(const std::vector<std::size_t>& corners, std::vector<fcl::Triangle>& triangles);
  std::optional<std::size_t> findEar(std::size_t corner, std::size_t left) const;
  bool isEar(std::size_t corner, Rule rule) const;
  bool isWithinWedge(std::size_t corner, std::size_t touching) const;
  double turn(std::size_t corner) const;
  void link(std::size_t corner_count);
  std::size_t remove(std::size_t corner);

  const std::vector<fcl::Vector3d>& vertices_;
  // The polygon that is being cut: what is left of it is a ring.
  std::vector<fcl::Vector3d> scaled_;  ///< from the first corner, the largest coordinate is 1
  std::vector<Point> points_;          ///< the same, seen along the normal, counter-clockwise
  std::vector<std::size_t> next_;
  std::vector<std::size_t> previous_;
  std::vector<std::size_t> reflex_;  ///< corners that do not turn left: only they can be in an ear
};

}  // namespace fcl_prob::detail
