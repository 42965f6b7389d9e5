// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The one rule of what is enough, and that who said no is not asked again.
#include "base/decision.h"

#include <array>
#include <random>

#include "base/until_no.h"
#include "catch.h"

using namespace fcl_prob;
using namespace fcl_prob::detail;

namespace {

Bounds randomBounds(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double scale = std::pow(10.0, -12.0 * uniform(random));
  const double lower = scale * uniform(random);
  return {lower, lower + scale * std::pow(10.0, -10.0 * uniform(random))};
}

ProbabilityRequest randomRequest(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  ProbabilityRequest request;
  request.relative_tolerance = std::pow(10.0, -8.0 * uniform(random));
  request.absolute_tolerance = std::pow(10.0, -14.0 * uniform(random));
  return request;
}

}  // namespace

TEST_CASE("a threshold is satisfied by a decision and by nothing else, a tolerance by a width") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-0.5, 1.5);
  std::array<int, 3> seen{};
  for (int i = 0; i < 20'000; ++i) {
    const Bounds bounds = randomBounds(random);
    ProbabilityRequest request = randomRequest(random);
    const bool is_narrow = bounds.width() <= request.toleranceAt(bounds.upper);
    const auto without = satisfied(bounds, request);
    CHECK(without.has_value() == is_narrow);
    request.threshold = std::max(0.0, bounds.lower + uniform(random) * bounds.width());
    const bool is_decided = bounds.upper < *request.threshold || bounds.lower > *request.threshold;
    const auto with = satisfied(bounds, request);
    CHECK(with.has_value() == is_decided);
    if (with) CHECK(*with == ProbabilityStatus::decided);
    // The standard error of an estimate is what its tolerance is for.
    request.method = ProbabilityMethod::estimate;
    CHECK(satisfied(bounds, request).has_value() == (is_decided || is_narrow));
    ++seen[is_decided ? 0 : is_narrow ? 1 : 2];
  }
  for (const int count : seen) CHECK(count > 1000);
}

TEST_CASE("no interval decides that has become narrower by less than is missing") {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int may = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Bounds bounds = randomBounds(random);
    ProbabilityRequest request = randomRequest(random);
    request.threshold = bounds.lower + uniform(random) * bounds.width();
    if (satisfied(bounds, request)) continue;
    const double missing = missingWidth(bounds, request);
    CHECK(missing >= 0.0);
    CHECK_FALSE(mayBeDecided(bounds, 0.99 * missing, request));
    CHECK(mayBeDecided(bounds, 1.01 * missing + 1e-15 * bounds.upper, request));
    ++may;
  }
  CHECK(may > 10'000);
}

TEST_CASE("who said no is not asked again, by no copy") {
  for (int last = 1; last < 20; ++last) {
    int calls = 0;
    ProbabilityRequest request;
    request.on_progress = [&](const ProbabilityProgress&) { return ++calls < last; };
    const ProbabilityRequest of_call = ofOneCall(request);
    const ProbabilityRequest of_part = ofOneCall(of_call);
    int refused = 0;
    for (int i = 0; i < 50; ++i) {
      refused += !(i % 2 == 0 ? of_call : of_part).on_progress({});
    }
    CHECK(calls == last);
    CHECK(refused == 51 - last);
    // Another call asks anew.
    CHECK_FALSE(ofOneCall(request).on_progress({}));
    CHECK(calls == last + 1);
  }
  CHECK_FALSE(ofOneCall(ProbabilityRequest()).on_progress);
}
