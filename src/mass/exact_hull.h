// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex polygons without a tolerance.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace fcl_prob::detail {

/// Whether c is to the left of the line from a to b: with coordinates as below, or such times a
/// power of two, never wrong. (Neither if it is on the line.)
bool turnsLeft(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

/// The corners of the convex hull of points whose coordinates are whole numbers below 2^52 (where
/// every turn is decided exactly), counter-clockwise, none within a side. However thin the polygon
/// is: two corners mean that all points are on a segment, one that they are equal.
std::vector<Eigen::Vector2d> exactHull(std::vector<Eigen::Vector2d> points);

}  // namespace fcl_prob::detail
