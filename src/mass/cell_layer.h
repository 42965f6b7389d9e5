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

}  // namespace fcl_prob::detail
