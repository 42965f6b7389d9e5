// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// P given where a body was turned to: the mass of a ball, of what is beyond a wall, of a polygon
// under a Gaussian translation. In closed form, or by quadrature; no code of the library.
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace fcl_prob_judge {

/// Standard normal distribution function.
double normalCdf(double x);

/// A Gaussian translation by `sigma` along the first `rank` (0 to 3) columns of a rotation.
struct Translation {
  double sigma = 0.0;
  int rank = 3;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();

  /// The part of `offset` along which it moves.
  Eigen::Vector3d within(const Eigen::Vector3d& offset) const;

  /// Standard deviation along a unit vector.
  double sigmaAlong(const Eigen::Vector3d& direction) const;
};

/// P(|offset + t| <= radius): noncentral chi-square.
double massOfBall(const Eigen::Vector3d& offset, double radius, const Translation& translation);

/// Not negative where that is not 0: how much of the ball's section is left beside the offset's
/// part along which nothing moves, square metres.
double ballWithin(const Eigen::Vector3d& offset, double radius, const Translation& translation);

/// P(from <= x + s z <= to).
double massBetween(double from, double to, double x, double s);

/// P(t in polygon), t ~ N(0, sigma² I): by Owen's T function. Corners counter-clockwise.
double massOfPolygon(const std::vector<Eigen::Vector2d>& corners, double sigma);

/// A rectangle in the plane.
struct Rectangle {
  Eigen::Vector2d centre;
  Eigen::Vector2d half;  ///< half of its sides
  double angle;
};

/// P(the first, displaced by N(0, sigma² I), meets the second).
double massOfRectangles(const Rectangle& first, const Rectangle& second, double sigma);

}  // namespace fcl_prob_judge
