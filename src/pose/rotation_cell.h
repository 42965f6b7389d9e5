// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A box of the whitened rotation space, and what is certain of contact within it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fcl_prob/bounds.h"
#include "pose/moved_frame.h"
#include "scene/point_motion.h"

namespace fcl_prob::detail {

/// { lo <= z <= hi } of z ~ N(0, I), with infinite sides at first.
struct RotationCell {
  Eigen::VectorXd lo;
  Eigen::VectorXd hi;
  Bounds mass;                      ///< certified
  Bounds conditional{0.0, 1.0};     ///< of P(contact | z in the cell), certified
  double open = 1.0;                ///< its width in the last cell around it that was looked at
  double moved_gap = 1.0;           ///< of it, what is left open by how points move in the cell
  Eigen::VectorXd curvature_parts;  ///< and by the curvature of P over shifts, by coordinate

  double looked_at = 4.0;   ///< MotionCosts of the last cell around it that was looked at
  std::size_t in_tree = 0;  ///< its number in a MassTree

  /// About what it leaves open.
  double gap() const { return mass.upper * open; }

  /// Of contact and z in the cell.
  Bounds contribution() const;
  bool isFinite() const { return lo.allFinite() && hi.allFinite(); }
};

/// All of the space. \param rank  1 to 3
RotationCell wholeRotationSpace(int rank);

/// About what the motion of points leaves open in a cell of widths w, up to a factor:
/// Σ first_j w_j + second_j w_j². Steers.
struct MotionCosts {
  Eigen::VectorXd first;
  Eigen::VectorXd second;

  double of(const RotationCell& cell) const {
    const Eigen::VectorXd width = cell.hi - cell.lo;
    return first.dot(width) + second.dot(width.cwiseAbs2());
  }
};

/// The parts of a cell. Infinite sides are cut off first, then coordinates are halved: the one by
/// which that leaves least open.
std::vector<RotationCell> split(const RotationCell& cell, const MotionCosts& costs);

/// How a pose error moves an object while z is in a finite cell. The object is where z_c, the
/// middle of the cell, puts it. Relative to that, a point x (world frame) is moved by
///   (R R_c⁻¹ - 1)(x - c) + (R R_c⁻¹ - 1)(c - p) + C (z - z_c),
/// p being what the rotation is about. The last two do not depend on x: to first order they are
/// linear in z, a shift that joins the displacement. Its mean over the cell is part of
/// `displacement`; how P varies around that is bounded by the curvature of a Gaussian's mass over
/// shifts. Or its variance is part of it, too: then only moments of third and fourth order are
/// left. What is left of the motion is `motion`.
struct CellMotion {
  fcl::Transform3d turned;            ///< moves the object to where z_c puts it
  GaussianDisplacement displacement;  ///< besides, at the mean of z in the cell
  PointMotion motion;
  Eigen::VectorXd curvatures;  ///< variance of the shift in the cell in deviations², by coordinate
  bool joined = false;         ///< `displacement` has the variance of the shift
  Eigen::VectorXd higher;      ///< if so: bound on what higher moments change P by, by coordinate
  double reach = 0.0;          ///< bound on the shift, in deviations
  double slack = 0.0;          ///< bound on its mean, in deviations: rounding
  double tail = 0.0;           ///< mass of displacements for which `motion` does not hold
};

/// \param reference  c, metres, world frame; any point is right, one near the contact is best
/// \param size       metres: no point that matters is farther from the origin
/// \param expected   about P given the cell; it only steers. 0: `joined` is not asked for
CellMotion motionOf(const MovedFrame& frame, const RotationCell& cell,
                    const Eigen::Vector3d& reference, double size, double expected);

/// Bounds on P(contact | z in the cell) from those, `inner`, at z_c: their lower end must hold for
/// contact throughout `motion`, the upper one for any contact within it.
void setConditional(const CellMotion& motion, const Bounds& inner, RotationCell& cell);

}  // namespace fcl_prob::detail
