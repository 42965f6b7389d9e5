// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Whether a convex mesh, taken whole, meets single triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "scene/whitened_fan.h"

namespace fcl_prob::detail {

enum class PointContact {
  none,
  touching,
  unknown  ///< within rounding it may be either
};

/// P against triangles that are given relative to its centre: its C-obstacle with a triangle holds
/// a point if P meets the triangle less that point, turned over. Planes tell that they are apart,
/// and one point of the triangle within all of them that they are not: nothing rests on which
/// planes and points are tried.
class FanContact {
 public:
  /// Keeps a reference to the fan.
  explicit FanContact(const WhitenedFan& fan);

  /// Tests that follow do not depend on those before, not even in what rounding leaves open.
  void forget() { recent_count_ = 0; }

  /// Whether a box is certainly apart from P. By the few planes that told so of others last.
  bool isClearOf(const Eigen::Vector3d& middle, const Eigen::Vector3d& half);

  /// \param corners  columns, no farther from the centre of P than the fan's reach()
  PointContact with(const Eigen::Matrix3d& corners);

 private:
  using Faces = std::array<int, 4>;

  bool anyRecentSeparates(const Eigen::Matrix3d& corners);
  void useFirst(std::size_t k);
  void remember(int face);
  int highestFace(double level) const;
  PointContact clip(const Eigen::Matrix3d& corners, double radius);
  bool cut(int face);
  bool holdsMiddle();

  const WhitenedFan& fan_;
  double outer_ = 0.0;  ///< what is higher than that above a face's plane is outside of P
  double inner_ = 0.0;  ///< what is lower than that below all of them is within P
  Faces recent_{};
  std::size_t recent_count_ = 0;

  // Of the triangle that is looked at.
  Eigen::VectorXd height_;  ///< of its middle above every plane
  std::vector<Eigen::Vector3d> polygon_;
  std::vector<Eigen::Vector3d> rest_;
  std::vector<double> above_;
};

}  // namespace fcl_prob::detail
