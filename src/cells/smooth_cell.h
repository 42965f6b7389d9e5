// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Cells in which the union of curved C-obstacles is a single quadric.
#pragma once

#include <optional>
#include <vector>

#include "cells/cell_front.h"
#include "cells/claim_observer.h"
#include "convex/nearest_feature.h"
#include "mass/quadric_mass.h"

namespace fcl_prob::detail {

/// What collides in a cell is what of it is in the quadric, but for `slack`.
struct SmoothPart {
  Quadric quadric;
  double slack = 0.0;
};

/// The C-obstacle of a sphere, an ellipsoid or a capsule and a polytope is a polytope, its core,
/// swept by an ellipsoid. In the frame in which that is the unit ball it is what is within 1 of the
/// core; where the nearest of the core is of one corner, edge or face, that is a ball, a cylinder
/// or a slab. Beside a mesh, whose pairs share the ellipsoid, the nearest of all cores counts.
class SmoothCell {
 public:
  /// Keeps references to both.
  SmoothCell(const WhitenedPair& pair, const ObstacleTable& obstacles);

  /// Certified mass of what collides in a cell that the pairs `cutting` may meet; nothing where it
  /// is not known as well as that. \param accuracy  as of cellQuadricMass()
  std::optional<Bounds> massOf(const Cell& cell, const std::vector<CuttingPair>& cutting,
                               double accuracy, ClaimObserver* observer);

  /// Nothing where that is not shown for all of the cell. \param cutting  all that may meet it
  std::optional<SmoothPart> quadricOf(const Cell& cell, const std::vector<CuttingPair>& cutting);

 private:
  /// The core of one pair, in the ball's frame relative to the middle of the cell.
  struct Core {
    std::vector<Eigen::Vector3d> points;
    NearestFeature nearest;  ///< to the middle of the cell
  };

  bool setFrame(const Eigen::Matrix3d& semi_axes);
  bool addCore(const FrontPair& pair);
  bool setFeature(const Core& core);
  bool endsWithin(const Core& core);
  bool footWithin(const Core& core, const Eigen::Vector3d& point);
  bool isBehindFeature(const Core& core);
  bool separates(const Core& core, const Eigen::Vector3d& direction);
  bool isDominated(const Core& core);
  double distanceAt(int corner) const;

  const WhitenedPair& pair_;
  const ObstacleTable& obstacles_;
  Eigen::Matrix3d semi_axes_;   ///< of the frame that is set
  Eigen::Matrix3d to_ball_;     ///< their inverse
  double inverse_error_ = 0.0;  ///< relative
  std::vector<Core> cores_;     ///< the first `used_` of them
  std::size_t used_ = 0;

  Eigen::Vector3d middle_, half_;        ///< of the cell
  Eigen::Matrix<double, 3, 8> corners_;  ///< of the cell, in the ball's frame
  double radius_ = 0.0;                  ///< of the cell there
  Eigen::Vector3d corner_;               ///< of the feature, there
  Eigen::Matrix3d across_;               ///< projects across the feature
  Eigen::Vector3d off_;                  ///< of the middle from the feature
  double projection_error_ = 0.0;
  double reach_ = 0.0;   ///< of the cell from the corner
  double slack_ = 0.0;   ///< how far the boundary may be off for what is rounded
  double nearer_ = 0.0;  ///< ... and for cores that are as near as the feature but for that
};

}  // namespace fcl_prob::detail
