// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Random points of what is open in a cell.
#pragma once

#include "cells/open_cell.h"

namespace fcl_prob::detail {

/// A point whose weight times density is the normal density over the open part of a cell, and 0
/// elsewhere.
struct CellDraw {
  Eigen::Vector3d point;
  double weight;
};

/// A point of the uncertain part with the density of the normal distribution up to `weight`: the
/// axis along which the plane is steepest is drawn last, between the planes. What the cell's `part`
/// counts is not left out. \param uniform  in the open unit cube
CellDraw drawFrom(const OpenCell& open, const Eigen::Vector3d& uniform);

/// The point of [lo, hi] below which lies the share `u` of the interval's normal mass.
double truncatedNormal(double lo, double hi, double u);

/// No draw of the cell has a larger weight.
double largestWeight(const OpenCell& open);

}  // namespace fcl_prob::detail
