// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The bounds of one C-obstacle after another, without new memory for each.
#pragma once

#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "bounds/tail_mean.h"
#include "convex/c_obstacle.h"
#include "convex/nearest.h"
#include "fcl_prob/convex_pcd.h"
#include "mass/polytope_effort.h"

namespace fcl_prob::detail {

/// Not for concurrent use.
class PairBounds {
 public:
  static constexpr double kNeverEnough = std::numeric_limits<double>::infinity();

  /// When it is due, the faces of a box stand for those of an obstacle.
  void setInterruption(Interruption interruption) {
    scratch_.interruption = std::move(interruption);
  }

  /// \param enough  all bounds may be 1 if it is seen early that the least would be at least this
  ConvexPcdBounds bounds(const CObstacle& obstacle, double enough = kNeverEnough);

  /// Certified mass of the polytope whose faces the C-obstacle gives.
  Bounds mass(const CObstacle& obstacle, const MassEffort& effort = {});

  /// The first moment of the same, of a polytope of rank 3; nothing if its faces cannot be had.
  std::optional<VectorBounds> moment(const CObstacle& obstacle, const Interruption& interruption);

 private:
  /// Brings the faces of `obstacle` into scratch_, cut and extruded if the displacement has rank 1
  /// or
  /// 2. The body reaches out of them by no more than the image of the unit ball under the result.
  Eigen::Matrix3d prepareFaces(const CObstacle& obstacle);

  Bounds massOfSection(int rank, const Eigen::Vector3d& error, const MassEffort& effort);
  ConvexPcdBounds ellipsoidBounds(const CObstacle& obstacle, const Ellipsoid& ball);

  ObstacleScratch scratch_;
  std::vector<TailValue> work_;
};

}  // namespace fcl_prob::detail
