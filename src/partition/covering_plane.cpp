// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/covering_plane.h"

#include <cmath>

namespace fcl_prob::detail {

namespace {

// More planes than this through one cell leave nothing worth having.
constexpr int kMostPlanes = 16;

// Rounding of a sum of products of unit normals and points within reach.
constexpr double kRounding = 1e-12;

struct CuttingPlane {
  Eigen::Vector3d outward;
  double inner;
  double outer;
};

// The planes of the obstacle's inner slabs that cut the cell.
struct CuttingPlanes {
  CuttingPlane plane[kMostPlanes];
  int count = 0;
  int deepest = -1;
  double depth = 0.0;  // of the deepest, 0 to 2: relative to the cell's radius along its normal
  bool too_many = false;
};

CuttingPlanes cuttingPlanes(const SlabArrays& slabs, const Cell& cell) {
  CuttingPlanes cutting;
  const Eigen::Vector3d center = 0.5 * (cell.lo + cell.hi);
  const Eigen::Vector3d half = 0.5 * (cell.hi - cell.lo);
  for (int i = 0; i < slabs.count; ++i) {
    const Eigen::Vector3d n(slabs.nx()[i], slabs.ny()[i], slabs.nz()[i]);
    const double middle = n.dot(center);
    const double radius = n.cwiseAbs().dot(half);
    for (const double sign : {1.0, -1.0}) {
      const double outer = sign > 0 ? slabs.hi()[i] : -slabs.lo()[i];
      const double inner = outer - slabs.margin()[i];
      const double excess = sign * middle + radius - inner + kRounding;
      if (excess <= 0) continue;
      if (cutting.count == kMostPlanes || !(radius > 0)) {
        cutting.too_many = true;
        return cutting;
      }
      if (excess / radius > cutting.depth) {
        cutting.depth = excess / radius;
        cutting.deepest = cutting.count;
      }
      cutting.plane[cutting.count++] = {sign * n, inner, outer};
    }
  }
  return cutting;
}

// Narrows the cell along the axis where it costs least until the plane does not cut it; the share
// of the cell that is left.
double narrow(const CuttingPlane& plane, const Cell& whole, Cell& cell) {
  double top = kRounding;
  double reach = 0.0;
  int axis = 0;
  for (int k = 0; k < cell.rank; ++k) {
    top += plane.outward[k] * (plane.outward[k] > 0 ? cell.hi[k] : cell.lo[k]);
    const double along = std::fabs(plane.outward[k]) * (whole.hi[k] - whole.lo[k]);
    if (along > reach) {
      reach = along;
      axis = k;
    }
  }
  const double excess = top - plane.inner;
  if (excess <= 0) return 1.0;
  const double before = cell.hi[axis] - cell.lo[axis];
  const double width = excess / std::fabs(plane.outward[axis]);
  if (!(width < before)) return 0.0;
  if (plane.outward[axis] > 0) {
    cell.hi[axis] -= width;
  } else {
    cell.lo[axis] += width;
  }
  return (before - width) / before;
}

}  // namespace

CoveringPlane coveringPlane(const SlabArrays& slabs, const Cell& cell) {
  CoveringPlane result;
  const CuttingPlanes cutting = cuttingPlanes(slabs, cell);
  if (cutting.too_many || cutting.deepest < 0) return result;
  result.within = cell;
  double share = 1.0 - 0.5 * cutting.depth;
  for (int i = 0; i < cutting.count && share > 0; ++i) {
    if (i != cutting.deepest) share *= narrow(cutting.plane[i], cell, result.within);
  }
  if (share <= 0) return result;
  const CuttingPlane& deepest = cutting.plane[cutting.deepest];
  result.inner = {-deepest.outward, -deepest.inner};
  result.outer = -deepest.outer;
  result.share = share;
  return result;
}

}  // namespace fcl_prob::detail
