// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Taylor models against the functions themselves, at random complex points.
#include <complex>

#include "catch.h"
#include "mass/taylor_model.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob::detail;
using namespace fcl_prob_test;
using Complex = std::complex<double>;

/// What the operations make of numbers, and of models of them.
template <class Number>
Number expression(int kind, const Number& s, const Number& t) {
  using std::sqrt;
  const Number square = 1.3 + 0.4 * s * s - s * t + t * t;
  if constexpr (std::is_same_v<Number, TaylorModel>) {
    if (kind == 0) return inverseSquareRoot(square) * (s - 0.3 * t);
    if (kind == 1) return squareRoot(square) * t + s;
  } else {
    if (kind == 0) return 1.0 / sqrt(square) * (s - 0.3 * t);
    if (kind == 1) return sqrt(square) * t + s;
  }
  return square * square - t * (s + 2.0);
}

Complex onDisc(RandomBodies& random) {
  return std::polar(random.integer(0, 1) ? 1.0 : std::sqrt(random.uniform(0.0, 1.0)),
                    random.uniform(0.0, 2.0 * M_PI));
}

TEST_CASE("Taylor models contain what the functions are") {
  RandomBodies random(211);
  for (int k = 0; k < 3000; ++k) {
    const double s = random.uniform(-1.0, 1.0), t = random.uniform(-1.0, 1.0);
    const double half_s = random.logUniform(1e-9, 0.4), half_t = random.logUniform(1e-9, 0.4);
    for (int kind = 0; kind < 3; ++kind) {
      const TaylorModel model =
          expression(kind, TaylorModel(s, half_s, 0.0, 0.0), TaylorModel(t, 0.0, half_t, 0.0));
      for (int n = 0; n < 5; ++n) {
        const Complex sigma = onDisc(random), tau = onDisc(random);
        const Complex value = expression<Complex>(kind, s + half_s * sigma, t + half_t * tau);
        const Complex linear = model.middle + model.first * sigma + model.second * tau;
        CHECK(std::abs(value - linear) <= model.radius + 4e-15);
        CHECK(std::abs(value) <= model.most() + 4e-15);
      }
    }
  }
}

TEST_CASE("a Taylor model knows nothing beyond the singularity of a root") {
  const TaylorModel z(0.5, 0.3, 0.2, 0.01);
  CHECK_FALSE(squareRoot(z).radius < kInfinity);
  CHECK_FALSE(inverseSquareRoot(z).radius < kInfinity);
  CHECK(squareRoot(TaylorModel(0.5, 0.2, 0.2, 0.01)).radius < kInfinity);
}

}  // namespace
