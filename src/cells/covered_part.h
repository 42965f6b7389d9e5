// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The part of a cell that a single C-obstacle covers, where several of its planes cut the cell.
#pragma once

#include <array>

#include "convex/slab_kernels.h"
#include "mass/cell_mass.h"
#include "mass/cut_cube.h"
#include "scene/front_pair.h"

namespace fcl_prob::detail {

/// A half-space { m·y >= s } of the whitened frame, m a unit vector.
struct CellPlane {
  Eigen::Vector3d m = Eigen::Vector3d::Zero();
  double s = 0.0;
};

/// A convex part of a cell: what lies within all of the half-spaces.
struct CoveredPart {
  static constexpr int kMostPlanes = 5;

  std::array<CellPlane, kMostPlanes> planes;
  int count = 0;  ///< 0: there is no such part
};

/// Certified bounds on the masses of parts of one cell.
///
/// They are volumes of the part times a density at its centroid: by Jensen's inequality the mean of
/// exp(f) is at least exp of the mean of f, and of f = -|y|²/2 a chord along each axis is a lower
/// bound, a tangent plane an upper one, above which exp is below its own chord.
///
/// For samples, that must leave out a set of which the mass is known, there are subsets of parts.
/// With t_k the share of the cell's mass below y_k along axis k, the cell is the unit cube and its
/// mass is spread evenly over it; planes become surfaces that are bent a little, and are replaced
/// by planes to one side of them.
class PartMeasure {
 public:
  explicit PartMeasure(const Cell& cell);

  /// Certainly not above the mass of the part.
  double massAtLeast(const CoveredPart& part, CubeCutter& cutter) const;

  /// Certainly not below it.
  double massAtMost(const CoveredPart& part, CubeCutter& cutter) const;

  /// The mass of the subset of the part that counts, rounded downwards.
  double countedMass(const CoveredPart& part, CubeCutter& cutter) const;

  /// ∫ y φ(y) dy over that subset.
  Moment moment(const CoveredPart& part, CubeCutter& cutter) const;

  /// Whether a point of the cell is in that subset.
  bool counts(const CoveredPart& part, const Eigen::Vector3d& y) const;

  /// How far a coordinate may be off what is taken for it: the larger, the smaller is the subset.
  double bend() const { return bend_.maxCoeff(); }

 private:
  CubePlane straightPlane(const CellPlane& plane, double sign) const;
  CubePlane bentPlane(const CellPlane& plane) const;
  std::optional<CutCube> cutBent(const CoveredPart& part, CubeCutter& cutter) const;
  std::optional<CutCube> cut(const CoveredPart& part, double sign, CubeCutter& cutter) const;
  Eigen::Vector3d centroidOf(const CutCube& cube) const;
  static double centroidError(const CutCube& cube);

  Cell cell_;
  Eigen::Vector3d width_;
  Eigen::Vector3d axis_mass_;  ///< of [lo_k, hi_k], for each axis that moves
  Eigen::Vector3d bend_;       ///< bound on |y_k(t_k) - lo_k - width_k t_k|
  Bounds whole_;               ///< mass of the cell
  double scale_ = 1.0;         ///< the cell's volume times the normal density at 0
};

/// The obstacle's part of a cell, if no more than `most` planes of the obstacle cut the cell; the
/// one that cuts most of it first.
struct ObstaclePart {
  CoveredPart part;
  double share = 0.0;  ///< roughly, of the cell that is covered; 0 if there is no part
  FrontPair by{{FrontPair::kNone, FrontPair::kNone}, FrontPair::kNone};  ///< who covers it
};

ObstaclePart obstaclePart(const SlabArrays& slabs, const Cell& cell, int most);

/// Of the obstacle's inner planes the one beyond which a point is farthest; m = 0 if it has none.
CellPlane farthestPlane(const SlabArrays& slabs, const Eigen::Vector3d& point);

}  // namespace fcl_prob::detail
