// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/covered_part.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/normal_density.h"

namespace fcl_prob::detail {

namespace {

// Rounding of a sum of products of unit normals and points within reach.
constexpr double kRounding = 1e-12;

// Along one axis y(t) is the inverse of the share of mass below y: y'' = y y'² and y' = mass /
// φ(y), so that y is off its chord by at most max |y''| / 8.
double bendOf(double lo, double hi, double mass) {
  const double farthest = std::max(std::fabs(lo), std::fabs(hi));
  const double density = kInverseSqrtTwoPi * std::exp(-0.5 * farthest * farthest);
  const double slope = mass / density;
  const double bend = farthest * slope * slope / 8 * (1 + 1e-12);
  return bend < hi - lo ? bend : hi - lo;  // also where the density underflows
}

}  // namespace

PartMeasure::PartMeasure(const Cell& cell)
    : cell_(cell),
      width_(cell.hi - cell.lo),
      axis_mass_(Eigen::Vector3d::Ones()),
      bend_(Eigen::Vector3d::Zero()),
      whole_(cellMass(cell)) {
  for (int k = 0; k < cell.rank; ++k) {
    axis_mass_[k] = normalIntervalMass(cell.lo[k], cell.hi[k]);
    bend_[k] = bendOf(cell.lo[k], cell.hi[k], axis_mass_[k]);
  }
}

// Within the half-space (sign 1), or around it (sign -1).
CubePlane PartMeasure::planeWithin(const CellPlane& plane, double sign) const {
  const Eigen::Vector3d& m = plane.m;
  CubePlane result{m.cwiseProduct(width_), plane.s - m.dot(cell_.lo) + sign * kRounding};
  for (int k = 0; k < cell_.rank; ++k) {
    // The curve is below its chord where y > 0 and above where y < 0: towards m on one side only.
    const bool above = sign * m[k] > 0 ? cell_.hi[k] <= 0 : cell_.lo[k] >= 0;
    if (!above) result.r += sign * std::fabs(m[k]) * bend_[k];
  }
  return result;
}

std::optional<CutCube> PartMeasure::cut(const CoveredPart& part, double sign,
                                        CubeCutter& cutter) const {
  CubePlane planes[CoveredPart::kMostPlanes];
  for (int i = 0; i < part.count; ++i) planes[i] = planeWithin(part.planes[i], sign);
  return cutter.cut(planes, part.count);
}

double PartMeasure::mass(const CoveredPart& part, CubeCutter& cutter) const {
  if (part.count == 0) return 0.0;
  const std::optional<CutCube> cube = cut(part, 1.0, cutter);
  return cube ? whole_.lower * std::max(0.0, cube->volume - CubeCutter::kError) : 0.0;
}

double PartMeasure::massAtMost(const CoveredPart& part, CubeCutter& cutter) const {
  const std::optional<CutCube> cube = cut(part, -1.0, cutter);
  return cube ? whole_.upper * std::min(1.0, cube->volume + CubeCutter::kError) : whole_.upper;
}

Moment PartMeasure::moment(const CoveredPart& part, CubeCutter& cutter) const {
  const std::optional<CutCube> cube = part.count > 0 ? cut(part, 1.0, cutter) : CutCube{};
  if (!cube) return {Eigen::Vector3d::Zero(), 0.0};
  // y is off its chord by 0 to bend, on the side that its sign tells.
  Eigen::Vector3d off = Eigen::Vector3d::Zero();
  for (int k = 0; k < cell_.rank; ++k) {
    if (cell_.lo[k] >= 0) off[k] = -0.5 * bend_[k];
    if (cell_.hi[k] <= 0) off[k] = 0.5 * bend_[k];
  }
  const double largest = cell_.largestCoordinates().maxCoeff();
  const double rounding = 10 * CubeCutter::kError * (largest + width_.maxCoeff());
  return {whole_.lower * (cube->volume * (cell_.lo + off) + width_.cwiseProduct(cube->moment)),
          whole_.lower * (cube->volume * (bend_ - off.cwiseAbs()).maxCoeff() + rounding)};
}

bool PartMeasure::counts(const CoveredPart& part, const Eigen::Vector3d& y) const {
  if (part.count == 0) return false;
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
  for (int k = 0; k < cell_.rank; ++k) {
    t[k] = normalIntervalMass(cell_.lo[k], y[k]) / axis_mass_[k];
  }
  for (int i = 0; i < part.count; ++i) {
    const CubePlane plane = planeWithin(part.planes[i], 1.0);
    if (plane.a.dot(t) < plane.r) return false;
  }
  return true;
}

ObstaclePart obstaclePart(const SlabArrays& slabs, const Cell& cell, int most) {
  ObstaclePart result;
  CoveredPart& part = result.part;
  const Eigen::Vector3d center = 0.5 * (cell.lo + cell.hi);
  const Eigen::Vector3d half = 0.5 * (cell.hi - cell.lo);
  double deepest = 0.0;
  double share = 1.0;
  for (int i = 0; i < slabs.count; ++i) {
    const Eigen::Vector3d n(slabs.nx()[i], slabs.ny()[i], slabs.nz()[i]);
    const double middle = n.dot(center);
    const double radius = n.cwiseAbs().dot(half);
    for (const double sign : {1.0, -1.0}) {
      const double inner = (sign > 0 ? slabs.hi()[i] : -slabs.lo()[i]) - slabs.margin()[i];
      const double excess = sign * middle + radius - inner + kRounding;
      if (excess <= 0) continue;
      if (part.count == most || !(excess < 2 * radius)) {
        part.count = 0;
        return result;
      }
      part.planes[part.count++] = {-sign * n, -inner};
      share *= 1.0 - 0.5 * excess / radius;
      if (excess / radius > deepest) {
        deepest = excess / radius;
        std::swap(part.planes[0], part.planes[part.count - 1]);
      }
    }
  }
  result.share = part.count > 0 ? share : 0.0;
  return result;
}

CoveredPart outerPart(const SlabArrays& slabs, const Cell& cell, int most) {
  CoveredPart part;
  std::array<double, CoveredPart::kMostPlanes> cut_off;  // of the planes, in descending order
  const Eigen::Vector3d center = 0.5 * (cell.lo + cell.hi);
  const Eigen::Vector3d half = 0.5 * (cell.hi - cell.lo);
  for (int i = 0; i < slabs.count; ++i) {
    const Eigen::Vector3d n(slabs.nx()[i], slabs.ny()[i], slabs.nz()[i]);
    const double middle = n.dot(center);
    const double radius = n.cwiseAbs().dot(half);
    for (const double sign : {1.0, -1.0}) {
      const double outer = sign > 0 ? slabs.hi()[i] : -slabs.lo()[i];
      const double excess = sign * middle + radius - outer;
      if (!(excess > 0.0)) continue;
      const double share = excess / radius;
      int at = part.count < most ? part.count++ : most;
      for (; at > 0 && cut_off[at - 1] < share; --at) {
        if (at == most) continue;
        cut_off[at] = cut_off[at - 1];
        part.planes[at] = part.planes[at - 1];
      }
      if (at == most) continue;
      cut_off[at] = share;
      part.planes[at] = {-sign * n, -outer};
    }
  }
  return part;
}

CellPlane farthestPlane(const SlabArrays& slabs, const Eigen::Vector3d& point) {
  CellPlane farthest;
  double beyond = -kInfinity;
  for (int i = 0; i < slabs.count; ++i) {
    const Eigen::Vector3d n(slabs.nx()[i], slabs.ny()[i], slabs.nz()[i]);
    if (slabs.hi()[i] >= kUnbounded || n.isZero(0.0)) continue;
    const double margin = slabs.margin()[i];
    for (const CellPlane& plane :
         {CellPlane{n, slabs.lo()[i] + margin}, CellPlane{-n, margin - slabs.hi()[i]}}) {
      const double by = plane.s - plane.m.dot(point);
      if (!(by > beyond)) continue;
      beyond = by;
      farthest = plane;
    }
  }
  return farthest;
}

}  // namespace fcl_prob::detail
