// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Integrals of log-concave functions that are known at a few places: against closed forms.
#include "mass/log_concave_integral.h"

#include <cmath>

#include "catch.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob;
using detail::LogConcaveIntegral;

constexpr double kPlaceError = 1e-14;

double tailAt(double x) { return 0.5 * std::erfc(x / std::sqrt(2.0)); }

/// Of a function with values known to a share of themselves, at some places.
template <class Function>
Bounds integralOf(const Function& f, double share, int places) {
  LogConcaveIntegral integral(kPlaceError);
  const auto add = [&](double z) {
    const double value = f(z);
    integral.add(z, {value * (1.0 - share), std::min(1.0, value * (1.0 + share))});
  };
  add(0.0);
  add(6.5);
  add(-6.5);
  for (int k = 3; k < places; ++k) {
    const double z = integral.widest();
    if (std::abs(z) > LogConcaveIntegral::kFarthestPlace) break;
    add(z);
  }
  return integral.bounds();
}

TEST_CASE("normal tails along a slanted line have a closed form") {
  RandomBodies random(9011);
  for (int k = 0; k < 400; ++k) {
    // ∫ φ(z) Q(a + b z) dz = Q(a / sqrt(1 + b²))
    const double a = random.uniform(-6.0, 30.0), b = random.logUniform(1e-6, 0.3);
    const double share = k % 2 ? random.logUniform(1e-12, 1e-4) : 4e-15;
    const double truth = tailAt(a / std::hypot(1.0, b));
    const auto f = [&](double z) { return tailAt(a + b * z); };
    INFO("a " << a << ", b " << b << ", share " << share);
    for (const int places : {3, 5, 9, 17}) {
      const Bounds mass = integralOf(f, share, places);
      CHECK(mass.lower <= truth * (1.0 + 1e-12));
      CHECK(mass.upper >= truth * (1.0 - 1e-12));
    }
  }
}

TEST_CASE("the gap falls with the square of the distances, to that of the values") {
  const double a = 4.0, b = 1e-2, truth = tailAt(a / std::hypot(1.0, b));
  const auto f = [&](double z) { return tailAt(a + b * z); };
  double before = 1.0;
  for (const int places : {3, 9, 27, 81}) {
    const double width = integralOf(f, 0.0, places).width() / truth;
    CHECK(width < 0.2 * before);
    before = width;
  }
  CHECK(integralOf([&](double z) { return tailAt(a + 1e-6 * z); }, 1e-8, 3).width() <
        2.6e-8 * tailAt(a));
}

TEST_CASE("exponentials are straight: nothing is left open but beyond the places") {
  for (const double slope : {-3.0, -0.5, 0.0, 1e-3, 2.0}) {
    const auto f = [&](double z) { return std::exp(slope * z - 80.0); };
    const double truth = std::exp(0.5 * slope * slope - 80.0);
    const Bounds mass = integralOf(f, 0.0, 8);
    CHECK(mass.contains(truth));
    CHECK(mass.width() < 1e-8 * truth);
  }
}

TEST_CASE("fewer than two places tell nothing, places where nothing is known little") {
  LogConcaveIntegral integral(kPlaceError);
  CHECK(integral.bounds().upper == 1.0);
  integral.add(0.0, {0.2, 0.3});
  CHECK(integral.bounds().lower == 0.0);
  CHECK(integral.bounds().upper == 1.0);
  integral.add(1.0, {0.0, 1.0});
  integral.add(-1.0, {0.0, 1.0});
  const Bounds mass = integral.bounds();
  CHECK(mass.lower == 0.0);
  CHECK(mass.upper > 0.2);
}

}  // namespace
