// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/principal_ball.h"

#include <algorithm>
#include <cmath>

#include "fcl_prob/normal_mass.h"
#include "mass/disc_mass.h"
#include "mass/ellipsoid_mass.h"

namespace fcl_prob::detail {
namespace {

/// Of a long double that becomes a double, and the division by a deviation.
constexpr double kRelative = 1.01 * kEpsilon;

/// Errors of the centre by which no density changes much are part of the rounding; larger ones are
/// added to the radius or taken from it.
constexpr double kSmallMove = 1e-9;

/// More than products below the least normal number lose.
constexpr double kUnderflowOfBall = 1e-306;

/// One axis: lengths in deviations.
struct Axis {
  double centre, radius, pole, centre_error, pole_error;
};

/// The part of a ball that the displacement can reach: across the axes where nothing moves its
/// radius is smaller.
struct Section {
  std::array<long double, 3> centre{};  ///< >= 0
  double centre_error = 0.0;
  long double radius = 0.0;
};

Axis axisOf(const Section& ball, const GaussianDisplacement& displacement, int k) {
  const long double deviation = displacement.standardDeviations()[k];
  Axis axis;
  axis.centre = static_cast<double>(ball.centre[k] / deviation);
  axis.radius = static_cast<double>(ball.radius / deviation);
  axis.pole = static_cast<double>((ball.centre[k] - ball.radius) / deviation);
  const double moved = static_cast<double>(ball.centre_error / deviation) * (1.0 + kRelative);
  axis.centre_error = kRelative * axis.centre + moved;
  // A long double may be no more than a double.
  const double wide = 4.0 * static_cast<double>(std::numeric_limits<long double>::epsilon());
  axis.pole_error = kRelative * std::abs(axis.pole) + wide * (axis.centre + axis.radius) + moved;
  return axis;
}

Bounds massOnLine(const Axis& axis) {
  const ChordMass mass =
      chordMass(axis.centre, axis.radius, axis.centre_error, kRelative * axis.radius);
  if (!(mass.error < kInfinity)) return {0.0, 1.0};
  return {mass.value - mass.error, mass.value + mass.error};
}

Bounds massOfSection(const Section& ball, const GaussianDisplacement& displacement) {
  const int rank = displacement.rank();
  // Deviations descend, so radii ascend.
  const Axis x = axisOf(ball, displacement, 0);
  if (rank == 1) return massOnLine(x);
  const Axis y = axisOf(ball, displacement, 1);
  if (rank == 2) {
    return discMass({x.centre, x.radius, y.centre, y.radius, y.pole, x.centre_error, y.centre_error,
                     y.pole_error, kRelative});
  }
  const Axis z = axisOf(ball, displacement, 2);
  WhitenedBall whitened;
  whitened.centre << x.centre, y.centre, z.centre;
  whitened.radius << x.radius, y.radius, z.radius;
  whitened.centre_error << x.centre_error, y.centre_error, z.centre_error;
  whitened.z_pole = z.pole;
  whitened.z_pole_error = z.pole_error;
  whitened.radius_error = kRelative;
  return ellipsoidMass(whitened);
}

/// From the cubes around and inside the ball, along its axes: wide, but of any scale.
Bounds massBetweenCubes(const Section& ball, const GaussianDisplacement& displacement) {
  Section inner = ball;
  inner.radius = ball.radius / std::sqrt(static_cast<long double>(displacement.rank()));
  Bounds mass{1.0, 1.0};
  for (int k = 0; k < displacement.rank(); ++k) {
    mass.lower *= std::max(0.0, massOnLine(axisOf(inner, displacement, k)).lower);
    mass.upper *= std::min(1.0, massOnLine(axisOf(ball, displacement, k)).upper);
  }
  const double rounding = 8.0 * kEpsilon;
  return {std::max(0.0, mass.lower * (1.0 - rounding) - kUnderflowOfBall),
          std::min(1.0, mass.upper * (1.0 + rounding) + kUnderflowOfBall)};
}

/// Radius of the section at a distance across the axes that move; 0 if the ball does not reach.
long double sectionRadius(long double radius, long double distance) {
  return radius > distance ? std::sqrt((radius - distance) * (radius + distance)) : 0.0L;
}

Bounds massOf(const Section& ball, const GaussianDisplacement& displacement) {
  if (!(ball.radius > 0.0L)) return {0.0, 0.0};
  Bounds mass = massOfSection(ball, displacement);
  mass.lower = std::max(mass.lower, 0.0);
  mass.upper = std::min(mass.upper, 1.0);
  if (!(mass.lower <= mass.upper)) mass = {0.0, 1.0};
  return mass.width() < 1.0 ? mass : massBetweenCubes(ball, displacement);
}

}  // namespace

Bounds principalBallMass(const PrincipalBall& ball, const GaussianDisplacement& displacement) {
  const int rank = displacement.rank();
  const Eigen::Vector3d& deviations = displacement.standardDeviations();
  if (rank == 0) return {0.0, 1.0};
  Section section;
  for (int k = 0; k < 3; ++k) section.centre[k] = std::abs(ball.centre[k]);
  long double across = 0.0L;
  for (int k = rank; k < 3; ++k) across = std::hypot(across, section.centre[k]);
  const bool small = ball.centre_error <= kSmallMove * deviations[rank - 1];
  const long double rounding = 8.0L * std::numeric_limits<long double>::epsilon();
  const long double off = rank < 3 ? std::sqrt(2.0L) * ball.centre_error + rounding * across : 0.0L;
  const long double moved =
      ball.radius_error + (small ? 0.0L : std::sqrt(3.0L) * ball.centre_error);
  section.centre_error = small ? ball.centre_error : 0.0;
  const long double radius = ball.radius;
  const long double inner = sectionRadius(radius - moved, across + off) * (1.0L - rounding);
  const long double outer =
      sectionRadius(radius + moved, std::max(across - off, 0.0L)) * (1.0L + rounding);
  section.radius = inner;
  const Bounds below = massOf(section, displacement);
  if (outer - inner <= 0.25L * kEpsilon * inner) {
    return below;
  }
  section.radius = outer;
  return {below.lower, massOf(section, displacement).upper};
}

}  // namespace fcl_prob::detail
