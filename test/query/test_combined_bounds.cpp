// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Intervals of P(any), against the same in extended precision at random points of the intervals.
#include <cmath>
#include <limits>

#include "catch.h"
#include "fcl_prob/combined_bounds.h"
#include "fcl_prob/exceptions.h"
#include "random_bodies.h"

using namespace fcl_prob;
using fcl_prob_test::RandomBodies;

namespace {

Bounds randomEvent(RandomBodies& random) {
  const double p = random.logUniform(1e-18, 1.0);
  const double q = p * random.uniform(0.5, 1.0);
  return {q, p};
}

// 1 - Π(1 - P), summed as P1 + (1 - P1) P2 + ...: every term is positive.
long double anyOfPoints(const std::vector<long double>& events) {
  long double any = 0.0L;
  long double none = 1.0L;
  for (const long double p : events) {
    any += none * p;
    none *= 1.0L - p;
  }
  return any;
}

}  // namespace

TEST_CASE("independent events: the interval holds 1 - Π(1 - P) of every choice, and is tight") {
  RandomBodies random(1);
  int small = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<Bounds> events;
    std::vector<long double> lowest, between, highest;
    const double scale = random.logUniform(1e-15, 1.0);
    for (int j = random.integer(1, 40); j > 0; --j) {
      Bounds event = randomEvent(random);
      event.lower *= scale;
      event.upper *= scale;
      events.push_back(event);
      lowest.push_back(event.lower);
      highest.push_back(event.upper);
      between.push_back(event.lower + random.uniform(0.0, 1.0) * event.width());
    }
    const Bounds any = anyOfIndependent(events);
    CHECK(any.lower <= anyOfPoints(lowest));
    CHECK(any.upper >= anyOfPoints(highest));
    CHECK(any.lower <= anyOfPoints(between));
    CHECK(any.upper >= anyOfPoints(between));
    CHECK(any.lower >= anyOfPoints(lowest) * (1 - 1e-13L));
    CHECK(any.upper <= anyOfPoints(highest) * (1 + 1e-13L));
    small += any.upper < 1e-9;
    const Bounds always = anyOf(events);
    CHECK(always.lower <= any.lower);
    CHECK(always.upper >= any.upper);
  }
  CHECK(small > 400);
}

TEST_CASE("any of no event, one event, a certain one") {
  CHECK(anyOf({}).upper == 0.0);
  CHECK(anyOfIndependent({}).upper == 0.0);
  const Bounds one{0.123456789, 0.2};
  CHECK(anyOf({one}).lower == one.lower);
  CHECK(anyOf({one}).upper == one.upper);
  CHECK(anyOfIndependent({one}).lower == one.lower);
  CHECK(anyOfIndependent({one}).upper == one.upper);
  CHECK(anyOfIndependent({one, {1.0, 1.0}}).lower == 1.0);
  CHECK(anyOf({{0.6, 0.7}, {0.5, 0.8}}).lower == 0.6);
  CHECK(anyOf({{0.6, 0.7}, {0.5, 0.8}}).upper == 1.0);
}

TEST_CASE("what is no interval of a probability is refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Bounds& wrong : {Bounds{-0.1, 0.5}, Bounds{0.6, 0.5}, Bounds{0.5, 1.1},
                              Bounds{nan, 0.5}, Bounds{0.5, nan}}) {
    CHECK_THROWS_AS(anyOf({{0.1, 0.2}, wrong}), InvalidRequest);
    CHECK_THROWS_AS(anyOfIndependent({wrong}), InvalidRequest);
  }
}
