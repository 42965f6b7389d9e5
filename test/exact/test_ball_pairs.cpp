// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Spheres under covariances with oblique axes, which are a rotation only to rounding: the truth, in
// more than 30 digits, is that of the doubles as they are.
#include <fcl/geometry/shape/sphere.h>

#include <array>

#include "catch.h"
#include "disc_truth.h"
#include "fcl_prob/convex_pcd.h"
#include "high_precision.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob;

struct ObliquePair {
  double radius_a, radius_b;
  Eigen::Isometry3d pose_a, pose_b;
  GaussianDisplacement displacement;

  Bounds mass() const {
    return convexPairMass(ConvexBody(fcl::Sphered(radius_a)), pose_a,
                          ConvexBody(fcl::Sphered(radius_b)), pose_b, displacement);
  }
};

/// Some deviations inside or outside, seen along the first axis, and anywhere across it.
ObliquePair randomPair(RandomBodies& random, const Eigen::Vector3d& deviations, double radius) {
  const double share = random.uniform(0.01, 0.99);
  ObliquePair pair{share * radius, (1.0 - share) * radius, Eigen::Isometry3d::Identity(),
                   Eigen::Isometry3d::Identity(),
                   GaussianDisplacement::fromStandardDeviations(deviations, random.quaternion())};
  const Eigen::Matrix3d axes = pair.displacement.axes();
  const double across = radius * random.uniform(0.0, 1.0);
  const double half = std::sqrt((radius - across) * (radius + across));
  const int rank = pair.displacement.rank();
  const double inside = half * random.uniform(-1.0, 1.0);
  const double outside = half + deviations[rank - 1] * random.uniform(0.0, 36.0);
  const Eigen::Vector3d along = axes.col(rank - 1);
  const Eigen::Vector3d aside = axes * (rank == 1 ? random.direction() : Eigen::Vector3d::UnitZ());
  pair.pose_a.translation() = 5.0 * radius * random.normalVector();
  pair.pose_b.translation() = pair.pose_a.translation() + radius * random.normalVector();
  const Eigen::Vector3d offset = pair.pose_b.translation() - pair.pose_a.translation();
  const double at = random.uniform(0.0, 1.0) < 0.3 ? inside : outside;
  const Eigen::Vector3d off = across * (aside - along * along.dot(aside)) + at * along;
  pair.displacement = pair.displacement.withMean(offset + off);
  return pair;
}

template <class Number>
using Vector = std::array<Number, 3>;

template <class Number>
Number dot(const Vector<Number>& x, const Vector<Number>& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

template <class Number>
Vector<Number> centreOf(const ObliquePair& pair) {
  Vector<Number> centre;
  for (int k = 0; k < 3; ++k) {
    centre[k] = Number(pair.pose_b.translation()[k]) - pair.pose_a.translation()[k] -
                pair.displacement.mean()[k];
  }
  return centre;
}

/// The displacement is the sum of these times independent normal numbers.
template <class Number>
Vector<Number> scaledAxis(const ObliquePair& pair, int k) {
  Vector<Number> axis;
  for (int i = 0; i < 3; ++i) {
    axis[i] = Number(pair.displacement.standardDeviations()[k]) * pair.displacement.axes()(i, k);
  }
  return axis;
}

template <class Number>
Number radiusOf(const ObliquePair& pair) {
  return Number(pair.radius_a) + pair.radius_b;
}

/// |centre - ξ axis| <= radius is an interval of ξ.
HighPrecision massOnLine(const ObliquePair& pair) {
  const Vector<HighPrecision> centre = centreOf<HighPrecision>(pair);
  const Vector<HighPrecision> axis = scaledAxis<HighPrecision>(pair, 0);
  const HighPrecision radius = radiusOf<HighPrecision>(pair);
  const HighPrecision square = dot(axis, axis), middle = dot(axis, centre) / square;
  const HighPrecision rest = radius * radius - dot(centre, centre) + middle * middle * square;
  if (rest <= 0) return 0;
  const HighPrecision half = sqrt(rest / square);
  return trueTail(abs(middle) - half) - trueTail(abs(middle) + half);
}

/// Along the principal axes of what two axes span, from their Gram matrix.
QuadPrecision massInPlane(const ObliquePair& pair) {
  using Number = QuadPrecision;
  const Vector<Number> centre = centreOf<Number>(pair);
  const Vector<Number> u = scaledAxis<Number>(pair, 0), v = scaledAxis<Number>(pair, 1);
  const Number uu = dot(u, u), uv = dot(u, v), vv = dot(v, v);
  const Number gap = (uu - vv) / 2, root = sqrt(gap * gap + uv * uv);
  const Number large = (uu + vv) / 2 + root, small = (uu * vv - uv * uv) / large;
  // Of the eigenvector of the larger one, (gap + root, uv); the other one is across.
  const Number length = sqrt((gap + root) * (gap + root) + uv * uv);
  const Number c = (gap + root) / length, s = uv / length;
  const Number cu = dot(centre, u), cv = dot(centre, v);
  const Number x = abs(c * cu + s * cv) / sqrt(large), y = abs(c * cv - s * cu) / sqrt(small);
  const Number radius = radiusOf<Number>(pair);
  const Number square = radius * radius - dot(centre, centre) + x * x + y * y;
  if (square <= 0) return 0;
  return DiscTruth<Number>(x, y, sqrt(square), sqrt(large), sqrt(small)).mass();
}

/// \param error  of the truth, relative
template <class Number>
void holds(const Bounds& mass, const Number& truth, double error) {
  CAPTURE(static_cast<double>(truth), mass.lower, mass.upper);
  REQUIRE(mass.lower <= mass.upper);
  REQUIRE(Number(mass.lower) <= truth * (1 + Number(error)));
  REQUIRE(Number(mass.upper) >= truth * (1 - Number(error)));
}

TEST_CASE("spheres moving along any line: the bounds hold 50 digits") {
  RandomBodies random(611);
  double widest = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const double deviation = random.logUniform(1e-3, 1e3);
    const double radius = deviation * random.logUniform(1e-3, 1e3);
    const ObliquePair pair = randomPair(random, {deviation, 0.0, 0.0}, radius);
    CAPTURE(i, radius / deviation);
    const Bounds mass = pair.mass();
    holds(mass, massOnLine(pair), 0.0);
    // Where the line only grazes the ball, an ε of a coordinate is much of the chord.
    if (mass.lower > 1e-280) widest = std::max(widest, mass.width() / mass.upper);
  }
  REQUIRE(widest < 1e-8);
}

TEST_CASE("spheres moving in any plane: the bounds hold 34 digits", "[slow]") {
  RandomBodies random(612);
  for (int i = 0; i < 60; ++i) {
    const double deviation = random.logUniform(1e-3, 1e3);
    const double other = deviation * random.logUniform(1.0, 1e3);
    const double radius = deviation * random.logUniform(1e-3, 1e3);
    const ObliquePair pair = randomPair(random, {other, deviation, 0.0}, radius);
    CAPTURE(i, radius / deviation, other / deviation);
    holds(pair.mass(), massInPlane(pair), 1e-16);
  }
}

}  // namespace
