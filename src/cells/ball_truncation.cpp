// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/ball_truncation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob::detail {

namespace {

// Of the masses between the planes, relative to the cell's: the cell is divided where it matters.
constexpr double kAccuracy = 1e-4;

// Distances from the origin of the nearest and the farthest point of the cell.
double nearest(const Cell& cell) {
  double square = 0.0;
  for (int k = 0; k < cell.rank; ++k) {
    const double distance = std::max({cell.lo[k], -cell.hi[k], 0.0});
    square += distance * distance;
  }
  return std::sqrt(square);
}

double farthest(const Cell& cell) {
  double square = 0.0;
  for (int k = 0; k < cell.rank; ++k) {
    const double distance = std::max(std::fabs(cell.lo[k]), std::fabs(cell.hi[k]));
    square += distance * distance;
  }
  return std::sqrt(square);
}

// The farthest that a corner of the cell is from the line along `n` through the origin, squared.
double squaredRadiusAround(const Cell& cell, const Eigen::Vector3d& n) {
  double largest = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector3d y;
    for (int k = 0; k < 3; ++k) y[k] = (corner >> k & 1) ? cell.hi[k] : cell.lo[k];
    largest = std::max(largest, (y - n.dot(y) * n).squaredNorm());
  }
  return largest * (1 + 32 * kEpsilon) + 64 * kEpsilon * kEpsilon * kReach * kReach;
}

Bounds widened(double mass) {
  const double error = 8 * kIntervalMassRelativeError;
  return {std::max(0.0, mass * (1 - error) - kUnderflow),
          std::min(1.0, mass * (1 + error) + std::numeric_limits<double>::min())};
}

}  // namespace

bool BallTruncation::missesBall(const Cell& cell) const {
  return nearest(cell) > radius_ * (1 + 8 * kEpsilon);
}

bool BallTruncation::isInBall(const Cell& cell) const {
  return farthest(cell) < radius_ * (1 - 8 * kEpsilon);
}

Bounds BallTruncation::massInBall(const Cell& cell) const {
  const Bounds whole = cellMass(cell);
  if (isInBall(cell)) return whole;
  if (missesBall(cell)) return {0.0, 0.0};
  const Eigen::Vector3d middle = 0.5 * (cell.lo + cell.hi);
  // Around the origin no single plane says anything.
  if (!(middle.norm() > 0.0)) return {0.0, whole.upper};
  const Eigen::Vector3d n = middle.normalized();
  const double rounding = 64 * kEpsilon * kReach;
  // The ball is below its tangent plane; what is below the lower plane and not farther from the
  // line along n than the cell is in the ball (a cell around the origin may reach below it).
  const double upper = cellHalfSpaceMass(cell, -n, -(radius_ + rounding), kAccuracy).upper;
  const double room = radius_ * radius_ - squaredRadiusAround(cell, n);
  double lowest = -rounding;
  for (int k = 0; k < cell.rank; ++k) lowest += n[k] * (n[k] > 0 ? cell.lo[k] : cell.hi[k]);
  const double plane = room > 0.0 ? std::sqrt(room) * (1 - 8 * kEpsilon) - rounding : 0.0;
  if (!(room > 0.0) || -lowest > plane) return {0.0, upper};
  return {cellHalfSpaceMass(cell, -n, -plane, kAccuracy).lower, upper};
}

Examination BallTruncation::truncated(const Cell& cell, const std::vector<FrontPair>& inherited,
                                      Examination&& whole) const {
  Examination result;
  const Bounds settled = whole.settled.mass;
  const Bounds open = whole.open ? Bounds{whole.open->lower, whole.open->upper} : Bounds{};
  if (!(settled.upper + open.upper > 0.0)) return result;
  OpenCell rest;
  // Where nothing is settled, the rest of the cell with its shorter front is all there is.
  const bool rest_only = whole.open && settled.upper <= 0.0;
  rest.cell = rest_only ? whole.open->cell : cell;
  if (rest_only) {
    rest.front = std::move(whole.open->front);
  } else {
    rest.front = inherited;
  }
  const Bounds inside = massInBall(rest.cell);
  const double outside = std::max(0.0, cellMass(rest.cell).upper - inside.lower);
  rest.upper = std::min(inside.upper, settled.upper + open.upper);
  rest.lower = std::clamp(settled.lower + open.lower - outside, 0.0, rest.upper);
  rest.drawn = rest.upper;
  if (rest.upper > 0.0) result.open = std::move(rest);
  return result;
}

// The mass outside never grows with the radius, so that beyond kReach that of kReach will do; it
// is below the smallest double.
BallMass ballMass(double radius, int rank) {
  if (rank == 0) return {{1.0, 1.0}, {0.0, 0.0}};
  if (!(radius < kReach)) return {{1.0 - kEpsilon, 1.0}, {0.0, std::numeric_limits<double>::min()}};
  constexpr double kSqrt2OverPi = 0.79788456080286535588;
  const double density = std::exp(-0.5 * radius * radius);
  if (rank == 1) {
    return {widened(normalIntervalMass(-radius, radius)), widened(2 * normalTailMass(radius))};
  }
  // exp(x) is as accurate as x, which is up to 745.
  const auto tail = [](double mass) -> Bounds {
    return {std::max(0.0, mass * (1 - 1e-12) - kUnderflow),
            std::min(1.0, mass * (1 + 1e-12) + std::numeric_limits<double>::min())};
  };
  if (rank == 2) return {widened(-std::expm1(-0.5 * radius * radius)), tail(density)};
  return {normalBallMass(0.0, radius),
          tail(2 * normalTailMass(radius) + kSqrt2OverPi * radius * density)};
}

}  // namespace fcl_prob::detail
