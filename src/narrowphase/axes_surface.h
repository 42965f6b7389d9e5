// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The boundary of the sum of two cylinders, or segments, and ellipsoids, as patches.
#pragma once

#include "narrowphase/curved_surface.h"

namespace fcl_prob::detail {

/// A sum with a second axis. Both frustums are cylinders or segments.
struct AxesSum {
  CurvedSum sum;
  Frustum second;
  LongMatrix3 second_frame;

  /// How far the surface may be from the boundary, mapped.
  double rounding() const;
};

/// Axes that are less apart than this (radians) are taken for parallel, and ones that are as near
/// to a right angle for perpendicular.
inline constexpr double kAxesTie = 1e-11;

/// Patches that close around the sum, by its normals: both axes and what is across them are in the
/// plane across A × B, and half circles through such points, from A × B to B × A, cut the sphere of
/// normals into gores. Within one no side changes, and if it has a pole (a normal along an axis)
/// that is a corner, from which fans of normals go out: along each of them that axis's rim stays
/// where it is. Along the half circles across an axis the sides are, at ±A × B parallelograms, at
/// the poles discs.
std::vector<SurfacePatch> axesSurface(const AxesSum& axes);

}  // namespace fcl_prob::detail
