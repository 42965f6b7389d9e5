// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The part of a cell between two parallel planes, and beyond one.
#pragma once

#include "mass/cell_mass.h"

namespace fcl_prob::detail {

/// By so much a layer is taken to be thicker on either side, which pays for all rounding of a box
/// around it.
inline constexpr double kLayerMargin = 1e-11;

/// A box around the part of a cell with from <= m·y <= to, |m| <= 1; the cell must have such a part
/// and reach no farther than kReach.
Cell layerBox(const Cell& cell, const Eigen::Vector3d& m, double from, double to);

/// Certainly no less than the mass of the part of a cell within a layer of that width across m, |m|
/// = 1, wherever it is.
double massNear(const Cell& cell, const Eigen::Vector3d& m, double width);

/// A lower bound of m·y over the points of the box [lo, hi], within kReach, with n·y >= s; infinite
/// if there are none. |m| <= 1; what n·y and s are rounded by within such a box has to be taken off
/// s.
double lowestBeyond(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi, const Eigen::Vector3d& m,
                    const Eigen::Vector3d& n, double s);

}  // namespace fcl_prob::detail
