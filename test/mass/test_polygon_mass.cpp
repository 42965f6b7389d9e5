// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/polygon_mass.h"

#include <algorithm>

#include "catch.h"
#include "high_precision.h"
#include "random_inputs.h"

namespace {

using namespace fcl_prob;
using Eigen::Vector2d;
using fcl_prob_test::HighPrecision;
using fcl_prob_test::logUniform;
using fcl_prob_test::trueIntervalMass;
using fcl_prob_test::uniform;

/// Anticlockwise, its sides divided at random.
detail::Polygon2 rectangle(const Vector2d& lower, const Vector2d& upper, int parts,
                           std::mt19937& random) {
  const Vector2d corners[] = {lower, {upper.x(), lower.y()}, upper, {lower.x(), upper.y()}};
  detail::Polygon2 polygon;
  for (int k = 0; k < 4; ++k) {
    const Vector2d &from = corners[k], &to = corners[(k + 1) % 4];
    std::vector<double> shares{0.0};
    for (int i = 1; i < parts; ++i) shares.push_back(uniform(random, 0.0, 1.0));
    std::sort(shares.begin(), shares.end());
    for (const double share : shares) polygon.push_back(from + share * (to - from));
  }
  // Not along the axes: where a share is rounded to, the side is bent by an ulp.
  for (Vector2d& p : polygon) {
    for (int k = 0; k < 2; ++k) {
      if (std::abs(p[k] - lower[k]) < 1e-15 * std::abs(lower[k])) p[k] = lower[k];
      if (std::abs(p[k] - upper[k]) < 1e-15 * std::abs(upper[k])) p[k] = upper[k];
    }
  }
  return polygon;
}

TEST_CASE("masses of rectangles with divided sides against products of tails") {
  std::mt19937 random(7);
  int tail = 0, small = 0, large = 0;
  for (int k = 0; k < 2000; ++k) {
    const double width = logUniform(random, 1e-4, 1e3), height = logUniform(random, 1e-4, 1e3);
    const double far = k % 2 == 0 ? uniform(random, 0.0, 25.0) : uniform(random, -2.0, 2.0);
    const Vector2d lower(far, k % 4 < 2 ? uniform(random, -1.0, 1.0) : far - 0.5 * height);
    const Vector2d upper = lower + Vector2d(width, height);
    const HighPrecision truth =
        trueIntervalMass(lower.x(), upper.x()) * trueIntervalMass(lower.y(), upper.y());
    if (truth < 1e-280) continue;
    const Bounds mass =
        detail::polygonMass(rectangle(lower, upper, 1 + k % 5, random), Vector2d::Zero());
    const double about = truth.convert_to<double>();
    CAPTURE(lower.transpose(), upper.transpose(), mass.lower, mass.upper, about);
    REQUIRE(HighPrecision(mass.lower) <= truth);
    REQUIRE(HighPrecision(mass.upper) >= truth);
    // Front and back cancel by how thin it is.
    const double thickness = std::min({width, height, 1.0});
    REQUIRE(mass.width() <= 1e-8 * about * std::max(1.0, 1e-2 / thickness));
    tail += about < 1e-40;
    small += width < 1e-2;
    large += width > 1e2;
  }
  CHECK(tail > 100);
  CHECK(small > 300);
  CHECK(large > 100);
}

// Sides that reach 1e10 deviations behind the origin must not be divided along all of that.
TEST_CASE("masses of triangles that are half-planes but for what is far away") {
  std::mt19937 random(9);
  for (int k = 0; k < 200; ++k) {
    const double size = logUniform(random, 1e3, 1e10), distance = uniform(random, 0.0, 5.0);
    const double angle = uniform(random, 0.0, 6.3);
    const Vector2d out(std::cos(angle), std::sin(angle)), along(-out.y(), out.x());
    const detail::Polygon2 triangle = {distance * out - size * along, distance * out + size * along,
                                       -uniform(random, 0.5, 2.0) * size * out};
    const Bounds mass = detail::polygonMass(triangle, Vector2d::Zero());
    const double truth = 0.5 * std::erfc(-distance / std::sqrt(2.0));
    CAPTURE(size, distance, angle, mass.lower, mass.upper, truth);
    // Corners so far away are rounded by an ε of that.
    REQUIRE(mass.lower <= truth * (1.0 + 1e-15 * size));
    REQUIRE(mass.upper >= truth * (1.0 - 1e-15 * size));
    REQUIRE(mass.width() <= 1e-12 + 2e-13 * size);
  }
}

TEST_CASE("a polygon's mass holds those of the polygons next to it") {
  std::mt19937 random(8);
  const double displacement = 1e-6;
  const Vector2d lower(1.0, -0.5), upper(2.0, 0.7);
  const Bounds mass =
      detail::polygonMass(rectangle(lower, upper, 3, random), Vector2d::Constant(displacement));
  for (const double moved : {-displacement, displacement}) {
    const Vector2d by(moved / std::sqrt(2.0), moved / std::sqrt(2.0));
    const Bounds other =
        detail::polygonMass(rectangle(lower - by, upper + by, 1, random), Vector2d::Zero());
    CHECK(mass.lower <= other.lower);
    CHECK(mass.upper >= other.upper);
  }
}

}  // namespace
