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

// Parts with smaller volumes, of the unit cube, have centroids that say nothing.
constexpr double kLeastVolume = 1e3 * CubeCutter::kError;

// Relative, of exponents up to 3 kReach² / 2, of exp and of a few products; absolute, where exp
// leaves the range of normal numbers.
constexpr double kRoundedDensity = 1e-10;
constexpr double kRoundedTail = 1e-300;

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
    scale_ *= width_[k] * kInverseSqrtTwoPi;
  }
}

// Of a half-space in the unit cube that is a little smaller (sign 1) or larger (sign -1).
CubePlane PartMeasure::straightPlane(const CellPlane& plane, double sign) const {
  return {plane.m.cwiseProduct(width_), plane.s - plane.m.dot(cell_.lo) + sign * kRounding};
}

std::optional<CutCube> PartMeasure::cut(const CoveredPart& part, double sign,
                                        CubeCutter& cutter) const {
  CubePlane planes[CoveredPart::kMostPlanes];
  for (int i = 0; i < part.count; ++i) planes[i] = straightPlane(part.planes[i], sign);
  return cutter.cut(planes, part.count);
}

// Of the cube, for volumes of kLeastVolume and more: those of volume and moment over the volume.
double PartMeasure::centroidError(const CutCube& cube) {
  return 3 * CubeCutter::kError / cube.volume;
}

Eigen::Vector3d PartMeasure::centroidOf(const CutCube& cube) const {
  const Eigen::Vector3d center = cell_.lo + width_.cwiseProduct(cube.moment / cube.volume);
  return center.cwiseMax(cell_.lo).cwiseMin(cell_.hi);
}

// The chord of -y²/2 over [lo, hi] is -((lo + hi) y - lo hi) / 2.
double PartMeasure::massAtLeast(const CoveredPart& part, CubeCutter& cutter) const {
  if (part.count == 0) return 0.0;
  const std::optional<CutCube> cube = cut(part, 1.0, cutter);
  if (!cube || cube->volume < kLeastVolume) return 0.0;
  const Eigen::Vector3d centroid = centroidOf(*cube);
  double exponent = 0.0;
  for (int k = 0; k < cell_.rank; ++k) {
    const double ends = cell_.lo[k] + cell_.hi[k];
    exponent -= 0.5 * (ends * centroid[k] - cell_.lo[k] * cell_.hi[k]);
    exponent -= 0.5 * std::fabs(ends) * width_[k] * centroidError(*cube);
  }
  const double volume = cube->volume - CubeCutter::kError;
  const double mass = scale_ * volume * std::exp(exponent) * (1 - kRoundedDensity);
  return std::max(0.0, mass - kRoundedTail);
}

// At the centroid c the tangent plane of -|y|²/2 is -|c|²/2 + s with s = -c·(y - c), of which the
// mean over the part is 0; within [least, most] exp(s) is below its chord.
double PartMeasure::massAtMost(const CoveredPart& part, CubeCutter& cutter) const {
  const std::optional<CutCube> cube = cut(part, -1.0, cutter);
  if (!cube) return whole_.upper;
  const bool has_centroid = cube->volume >= kLeastVolume;
  const Eigen::Vector3d c = has_centroid ? centroidOf(*cube) : 0.5 * (cell_.lo + cell_.hi);
  double exponent = 0.0;
  double least = -kRounding;
  double most = kRounding;
  double mean = kRounding;
  for (int k = 0; k < cell_.rank; ++k) {
    exponent -= 0.5 * c[k] * c[k];
    const double ends[] = {c[k] * (c[k] - cell_.lo[k]), c[k] * (c[k] - cell_.hi[k])};
    least += std::min(ends[0], ends[1]);
    most += std::max(ends[0], ends[1]);
    mean += std::fabs(c[k]) * width_[k] * centroidError(*cube);
  }
  double tilt = std::exp(most);
  if (has_centroid) {
    const double of_least = std::exp(least);
    tilt = (most * of_least - least * tilt + mean * (tilt - of_least)) / (most - least);
  }
  const double volume = cube->volume + CubeCutter::kError;
  const double mass = scale_ * volume * std::exp(exponent) * tilt * (1 + kRoundedDensity);
  return std::min(whole_.upper, mass + kRoundedTail);
}

// The half-space's inside, in shares of mass.
CubePlane PartMeasure::bentPlane(const CellPlane& plane) const {
  const Eigen::Vector3d& m = plane.m;
  CubePlane result = straightPlane(plane, 1.0);
  for (int k = 0; k < cell_.rank; ++k) {
    // The curve is below its chord where y > 0 and above where y < 0: towards m on one side only.
    const bool above = m[k] > 0 ? cell_.hi[k] <= 0 : cell_.lo[k] >= 0;
    if (!above) result.r += std::fabs(m[k]) * bend_[k];
  }
  return result;
}

std::optional<CutCube> PartMeasure::cutBent(const CoveredPart& part, CubeCutter& cutter) const {
  CubePlane planes[CoveredPart::kMostPlanes];
  for (int i = 0; i < part.count; ++i) planes[i] = bentPlane(part.planes[i]);
  return cutter.cut(planes, part.count);
}

double PartMeasure::countedMass(const CoveredPart& part, CubeCutter& cutter) const {
  if (part.count == 0) return 0.0;
  const std::optional<CutCube> cube = cutBent(part, cutter);
  return cube ? whole_.lower * std::max(0.0, cube->volume - CubeCutter::kError) : 0.0;
}

Moment PartMeasure::moment(const CoveredPart& part, CubeCutter& cutter) const {
  const std::optional<CutCube> cube = part.count > 0 ? cutBent(part, cutter) : CutCube{};
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
    const CubePlane plane = bentPlane(part.planes[i]);
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
