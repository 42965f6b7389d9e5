// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/cell_layer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/constants.h"

namespace fcl_prob::detail {

namespace {

// Of a sum of a few products of coordinates within reach and of parts of unit vectors.
constexpr double kRoundingOfSum = 1e-13;

}  // namespace

Cell layerBox(const Cell& cell, const Eigen::Vector3d& m, double from, double to) {
  Cell box = cell;
  const double least = m.dot(cell.lowestCorner(m));
  const double most = m.dot(cell.lowestCorner(-m));
  for (int k = 0; k < cell.rank; ++k) {
    const double slope = std::fabs(m[k]);
    const double own = slope * (cell.hi[k] - cell.lo[k]);
    // What the other axes add up to is often nothing, but for rounding of either sign: the margin
    // pays for it only where it comes off before anything is known to be positive.
    const double others = most - least - own;
    // Starting at either end of the cell along m, the planes are met after at least so much of k.
    const double from_least = std::max(from - least - others - kLayerMargin, 0.0);
    const double from_most = std::max(most - to - others - kLayerMargin, 0.0);
    if (!(from_least + from_most < own)) continue;
    double& near = m[k] > 0 ? box.lo[k] : box.hi[k];
    double& far = m[k] > 0 ? box.hi[k] : box.lo[k];
    const double sign = m[k] > 0 ? 1.0 : -1.0;
    near += sign * from_least / slope;
    far -= sign * from_most / slope;
  }
  return box;
}

// A plane that hardly leans along the axes that move cuts a wide layer out of them.
double massNear(const Cell& cell, const Eigen::Vector3d& m, double width) {
  if (!(width > 0.0)) return 0.0;
  double exponent = 0.0;
  for (int i = 0; i < cell.rank; ++i) {
    const double nearest = std::max({cell.lo[i], -cell.hi[i], 0.0});
    exponent += nearest * nearest;
  }
  // The density is at most (2π)^{-rank/2} <= 0.4^rank; a plane's section of a cube of side 1 is at
  // most √2 long or large.
  const double section = 1.5 * std::pow(cell.largestWidth(), cell.rank - 1);
  const double density = std::pow(0.4, cell.rank) * std::exp(-0.5 * exponent);
  const double thickness = width / m.head(cell.rank).norm();
  return std::min(cellMass(cell).upper, thickness * density * section);
}

// From the corner that is lowest along m to the plane, along the axes by which that costs least: a
// linear program of one constraint is solved by sorting.
double lowestBeyond(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi, const Eigen::Vector3d& m,
                    const Eigen::Vector3d& n, double s) {
  struct Way {
    double gain;  ///< of n·y, of one step
    double cost;  ///< of m·y
    double room;
  };
  Way ways[3];
  int count = 0;
  double lowest = -kRoundingOfSum;
  double missing = s;
  for (int k = 0; k < 3; ++k) {
    const bool from_lo = m[k] != 0.0 ? m[k] > 0.0 : n[k] < 0.0;
    const double corner = from_lo ? lo[k] : hi[k];
    lowest += m[k] * corner;
    missing -= n[k] * corner;
    const double gain = from_lo ? n[k] : -n[k];
    if (gain > 0.0) ways[count++] = {gain, std::fabs(m[k]), hi[k] - lo[k]};
  }
  if (!(missing > 0.0)) return lowest;
  const auto cheaper = [](const Way& one, const Way& other) {
    return one.cost * other.gain < other.cost * one.gain;
  };
  if (count > 1 && cheaper(ways[1], ways[0])) std::swap(ways[0], ways[1]);
  if (count > 2 && cheaper(ways[2], ways[1])) std::swap(ways[1], ways[2]);
  if (count > 2 && cheaper(ways[1], ways[0])) std::swap(ways[0], ways[1]);
  for (int i = 0; i < count; ++i) {
    const Way& way = ways[i];
    if (missing <= way.gain * way.room) return lowest + way.cost * (missing / way.gain);
    lowest += way.cost * way.room;
    missing -= way.gain * way.room;
  }
  return kInfinity;
}

}  // namespace fcl_prob::detail
