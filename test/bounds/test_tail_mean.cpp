// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bounds/tail_mean.h"

#include <algorithm>
#include <array>
#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "catch.h"
#include "fcl_prob/normal_mass.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob::detail;
using fcl_prob_test::RandomBodies;
using Precise = boost::multiprecision::cpp_bin_float_100;

/// G(l) = (1 + l²) Φ(-l) - l φ(l).
Precise antiderivative(const Precise& l) {
  const Precise root_two = sqrt(Precise(2));
  const Precise pi = boost::math::constants::pi<Precise>();
  const Precise tail = boost::math::erfc(l / root_two) / 2;
  return (1 + l * l) * tail - l * exp(-l * l / 2) / sqrt(2 * pi);
}

/// 2 G[a, b, c] for three different values.
Precise dividedDifference(double a, double b, double c) {
  const Precise ga = antiderivative(a);
  const Precise gb = antiderivative(b);
  const Precise gc = antiderivative(c);
  const Precise ab = (gb - ga) / (Precise(b) - Precise(a));
  const Precise bc = (gc - gb) / (Precise(c) - Precise(b));
  return 2 * (bc - ab) / (Precise(c) - Precise(a));
}

TEST_CASE("the mean of the tail over a triangle, near and far, close and spread") {
  RandomBodies random(51);
  int close = 0;
  int spread = 0;
  int deep = 0;
  int negative = 0;
  for (int i = 0; i < 600; ++i) {
    const double base = random.uniform(-12.0, 25.0);
    std::array<double, 3> l;
    for (double& value : l) value = base + random.logUniform(1e-9, 300.0);
    std::sort(l.begin(), l.end());
    if (!(l[0] < l[1] && l[1] < l[2])) continue;
    close += l[2] - l[0] < 0.05;
    spread += l[2] - l[0] > 5.0;
    deep += l[0] > 10.0;
    negative += l[2] < 0.0;
    std::shuffle(l.begin(), l.end(), std::mt19937(i));
    const double expected = static_cast<double>(dividedDifference(l[0], l[1], l[2]));
    const double found = tailMean(TailValue(l[0]), TailValue(l[1]), TailValue(l[2]));
    const double least = *std::min_element(l.begin(), l.end());
    INFO("l = " << l[0] << ", " << l[1] << ", " << l[2] << " expected " << expected << " found "
                << found);
    CHECK(std::abs(found - expected) <= tailMeanError(least) * expected);
  }
  CHECK(close > 20);
  CHECK(spread > 120);
  CHECK(deep > 120);
  CHECK(negative > 8);
}

TEST_CASE("equal values: the mean is the value") {
  for (const double l : {-40.0, -3.0, 0.0, 1e-300, 2.0, 8.0, 30.0}) {
    const double expected = 2.0 * fcl_prob::normalTailMass(l);
    const double found = tailMean(TailValue(l), TailValue(l), TailValue(l));
    CHECK(found == Approx(expected).epsilon(1e-13));
  }
  CHECK(tailMean(TailValue(50), TailValue(60), TailValue(70)) == 0.0);
}

TEST_CASE("the series of differences keeps relative accuracy in narrow bodies") {
  RandomBodies random(52);
  for (int i = 0; i < 100; ++i) {
    const double centre = random.uniform(-3.0, 20.0);
    const double width = random.logUniform(1e-12, 0.05) / std::max(1.0, centre);
    REQUIRE(TailSeries::converges(centre, width));
    const double a = centre + 0.9 * width;
    const double b = centre + 0.3 * width;
    const double c = centre + 0.1 * width;
    const Precise at_centre = boost::math::erfc(Precise(centre) / sqrt(Precise(2)));
    const double expected = static_cast<double>(dividedDifference(a, b, c) - at_centre);
    CHECK(TailSeries(centre).meanDifference(a, b, c) ==
          Approx(expected).epsilon(1e-11).margin(1e-300));
  }
}

}  // namespace
