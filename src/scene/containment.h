// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Whether one object is inside the other where their surfaces do not meet (contact = solid).
#pragma once

#include <vector>

#include "fcl_prob/whitening.h"
#include "mass/cell_mass.h"
#include "scene/boxes_within.h"
#include "scene/surface_parts.h"

namespace fcl_prob::detail {

/// A connected part of an object's surface is all inside the other solid or all outside where the
/// surfaces do not meet: a point of it tells, and only where the box around that part (not around
/// the object, whose other parts may be anywhere) fits into the solid's there is anything to ask.
class SolidContact {
 public:
  SolidContact(const PartitionObject& a, const PartitionObject& b, const Whitening& whitening,
               const WhitenedPair& pair);

  /// False only if no part of either object can be inside the other for any displacement of the
  /// cell.
  bool possible(const Cell& cell) const;

  /// Whether, at a whitened displacement at which the surfaces do not meet, the solids overlap.
  Containment at(const Eigen::Vector3d& y) const;

 private:
  /// A point of a connected part of the inner object.
  struct PartPoint {
    Eigen::Vector3d position;  ///< at y = 0, frame of the outer solid, metres
    double error;              ///< bound on that of each coordinate, metres
  };

  /// All connected parts of the inner object, in one solid of the outer one.
  struct Direction {
    const ClosedMesh* outer;
    std::vector<PartPoint> points;
    Eigen::Matrix3d shift;  ///< whitened displacement to the frame of the outer one
    NodeBox outer_box;      ///< whitened, padded by rounding; y = 0
    double sign;            ///< of the displacement of the inner object: 1 if that is A
  };

  /// How the inner object is displaced.
  struct Motion {
    double sign;
    Eigen::Vector3d mean;      ///< world frame, metres
    Eigen::Vector3d rounding;  ///< of whitened boxes
  };

  void addDirections(const PartitionObject& inner, const std::vector<SurfacePart>& parts,
                     const PartitionObject& outer, const WhitenedTree& of_outer,
                     const Motion& motion);
  template <typename Function>
  bool visitFitting(const Direction& direction, const Cell& cell, Function&& function) const;
  Containment decide(const Direction& direction, const Eigen::Vector3d& y) const;

  Eigen::Matrix3d unwhitening_;
  BoxesWithin parts_of_a_;
  BoxesWithin parts_of_b_;
  std::vector<Direction> directions_;
};

}  // namespace fcl_prob::detail
