// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <limits>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/normal_mass.h"
#include "high_precision.h"
#include "random_inputs.h"

using fcl_prob_test::HighPrecision;
using fcl_prob_test::logUniform;
using fcl_prob_test::trueTail;
using fcl_prob_test::uniform;

namespace fcl_prob {
namespace {

HighPrecision trueDensity(const HighPrecision& h) {
  return exp(-h * h / 2) / sqrt(2 * boost::math::constants::pi<HighPrecision>());
}

// The closed form in 50 digits, of which a radius of 1e-8 costs 24.
HighPrecision trueBallMass(double distance, double radius) {
  const HighPrecision d = distance, r = radius;
  const HighPrecision interval =
      d < r ? 1 - trueTail(r - d) - trueTail(d + r) : trueTail(d - r) - trueTail(d + r);
  return interval - (trueDensity(d - r) - trueDensity(d + r)) / d;
}

}  // namespace

TEST_CASE("ball mass for every size, from the origin far into the tails") {
  std::mt19937 random(1);
  int tiny = 0, tail = 0, around = 0, count = 0;
  double worst_width = 0, worst_error = 0;
  for (int i = 0; i < 3000; ++i) {
    const double radius = logUniform(random, 1e-8, 1e3);
    const double gap = i % 3 == 0 ? uniform(random, -4, 4) : uniform(random, 0, 36);
    const double distance = std::max(1e-3, i % 2 == 0 ? radius + gap : std::abs(gap));
    const HighPrecision truth = trueBallMass(distance, radius);
    if (truth < 1e-290) continue;
    const Bounds bounds = normalBallMass(distance, radius);
    CAPTURE(distance, radius, bounds.lower, bounds.upper);
    REQUIRE(HighPrecision(bounds.lower) <= truth);
    REQUIRE(HighPrecision(bounds.upper) >= truth);
    worst_width = std::max(worst_width, bounds.width() / bounds.upper);
    worst_error = std::max(worst_error, fcl_prob_test::relativeError(bounds.middle(), truth));
    ++count;
    tiny += radius < 1e-4;
    tail += truth < 1e-50;
    around += distance < radius;
  }
  CAPTURE(worst_width, worst_error);
  CHECK(worst_width < 1e-12);
  CHECK(worst_error < 1e-13);
  CHECK(count > 2000);
  CHECK(tiny > 400);
  CHECK(tail > 200);
  CHECK(around > 300);
}

TEST_CASE("ball mass at the origin, of nothing and of everything") {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double radius : {1e-6, 0.1, 1.0, 1.9, 2.1, 5.0}) {
    // The chi-square distribution; a ball of distance 1e-30 has the same mass.
    const Bounds central = normalBallMass(0, radius);
    const HighPrecision r = radius;
    const HighPrecision truth = 1 - 2 * trueTail(r) - 2 * r * trueDensity(r);
    CHECK(HighPrecision(central.lower) <= truth);
    CHECK(HighPrecision(central.upper) >= truth);
    CHECK(normalBallMass(1e-30, radius).middle() == Approx(central.middle()).epsilon(1e-14));
  }
  CHECK(normalBallMass(1, 0).upper == 0);
  CHECK(normalBallMass(1, infinity).lower == 1);
  CHECK(normalBallMass(1, 1e300).lower > 1 - 1e-12);
  CHECK(normalBallMass(1e300, 1).upper < 1e-300);
  CHECK(normalBallMass(0, 50).upper <= 1);
  CHECK_THROWS_AS(normalBallMass(-1, 1), InvalidGeometry);
  CHECK_THROWS_AS(normalBallMass(1, std::nan("")), InvalidGeometry);
}

}  // namespace fcl_prob
