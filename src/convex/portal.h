// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where a ray from inside a C-obstacle leaves it, by refining a triangle that the ray pierces.
#pragma once

#include <Eigen/Core>
#include <array>

#include "convex/support_obstacle.h"

namespace fcl_prob::detail {

/// A triangle of points of V that the line { origin + t·direction } pierces. Refining it
/// ("Minkowski portal refinement", Snethen 2008) moves it along the line towards the boundary of V.
/// Everything that is read from a portal holds whether or not the search converged: its corners are
/// points of V, and so are their convex combinations.
class Portal {
 public:
  /// \param origin  a point of V
  Portal(const SupportObstacle& obstacle, const Eigen::Vector3d& origin,
         const Eigen::Vector3d& direction);

  /// False if no triangle that the line pierces was found: `origin` is not inside V, or rounding.
  bool found() const { return found_; }

  /// Outward unit normal of the triangle's plane.
  const Eigen::Vector3d& normal() const { return normal_; }

  /// V reaches beyond the triangle's plane by at most about this; infinite before any refine().
  double slack() const { return slack_; }

  /// One step outwards. False if it made no progress.
  bool refine();

  /// The point in which the ray pierces the triangle: a convex combination of its corners, which
  /// may lie off the ray by rounding.
  Eigen::Vector3d piercedPoint() const;

  /// Whether `point`, on the ray, lies between the origin and the triangle. If so, `combination`
  /// is a convex combination of the origin and the corners that is `point` but for rounding.
  bool holds(const Eigen::Vector3d& point, Eigen::Vector3d& combination) const;

 private:
  bool discover(double lean);
  bool orient();
  std::array<double, 3> weights() const;

  const SupportObstacle& obstacle_;
  Eigen::Vector3d origin_;
  Eigen::Vector3d direction_;
  std::array<Eigen::Vector3d, 3> corners_;  // relative to the origin, anticlockwise from outside
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
  double slack_;
  bool found_;
};

}  // namespace fcl_prob::detail
