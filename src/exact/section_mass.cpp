// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/section_mass.h"

#include <algorithm>

#include "base/constants.h"
#include "exact/principal_section.h"
#include "exact/section_polygons.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob::detail {
namespace {

/// Of the gap between two polygons, next to the mass: its middle is good to 1e-7, in milliseconds.
constexpr double kPolygonAccuracy = 2e-7;

/// Of an end in deviations: a sum, a quotient and a rounding.
constexpr double kEndRounding = 2.0 * kEpsilon;

Bounds lineMass(const PrincipalSection& section) {
  const AxisSection axis = axisSection(section);
  if (axis.meeting == Meeting::none) return {0.0, 0.0};
  if (axis.meeting == Meeting::unknown) return {0.0, 1.0};
  const PrincipalObstacle& obstacle = section.obstacle();
  const auto whitened = [&](double x) {
    return static_cast<double>((x + obstacle.offset().x()) / obstacle.deviations().x());
  };
  const auto moved = [](double end, double sign) {
    return end + sign * kEndRounding * std::abs(end);
  };
  const double inner = normalIntervalMass(moved(whitened(axis.inner.lower), 1.0),
                                          moved(whitened(axis.inner.upper), -1.0));
  const double outer = normalIntervalMass(moved(whitened(axis.outer.lower), -1.0),
                                          moved(whitened(axis.outer.upper), 1.0));
  return {std::max(0.0, inner * (1.0 - 2.0 * kIntervalMassRelativeError) - kUnderflow),
          std::min(1.0, outer * (1.0 + 2.0 * kIntervalMassRelativeError) + 1e-300)};
}

}  // namespace

Bounds sectionMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                   const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                   const Interruption& interruption) {
  const PairFrame frame = pairFrame(a, pose_a, b, pose_b, displacement);
  if (!frame.fits || frame.rank < 1 || frame.rank > 2) return {0.0, 1.0};
  const PrincipalObstacle obstacle(frame, a, pose_a, b, pose_b, displacement);
  const PrincipalSection section(obstacle);
  if (frame.rank == 1) return lineMass(section);
  return SectionPolygons(section, interruption).mass(kPolygonAccuracy);
}

}  // namespace fcl_prob::detail
