// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Standard errors of means of bounded samples, whatever their distribution.
#include "gaussian/bounded_mean.h"

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "catch.h"

using fcl_prob::detail::BoundedMean;
using fcl_prob::detail::MeanBound;

namespace {

using Draw = std::function<double(std::mt19937_64&)>;

double uniform(std::mt19937_64& random) {
  return std::uniform_real_distribution<double>(0.0, 1.0)(random);
}

/// As often 1 as told, else 0.
Draw hits(double rate) {
  return [rate](std::mt19937_64& random) { return uniform(random) < rate ? 1.0 : 0.0; };
}

BoundedMean meanOf(const Draw& draw, int count, double least, double most, unsigned seed) {
  std::mt19937_64 random(seed);
  BoundedMean mean(least, most);
  for (int i = 0; i < count; ++i) mean.add(draw(random));
  return mean;
}

}  // namespace

TEST_CASE("means of samples that seldom tell are within six standard errors") {
  const int count = 400;
  for (const double rate : {1e-6, 1e-4, 1e-3, 0.01, 0.03, 0.1, 0.5, 0.9, 0.99, 0.999, 1.0 - 1e-6}) {
    // Signs that even out, and one of a thousand times the size of the others.
    const std::vector<std::pair<Draw, double>> distributions{
        {hits(rate), rate},
        {[rate](auto& random) {
           const double u = uniform(random);
           return u < rate ? (u < 0.7 * rate ? 1.0 : -1.0) : 0.0;
         },
         0.4 * rate},
        {[rate](auto& random) { return uniform(random) < rate ? 1.0 : 1e-3 * uniform(random); },
         rate + 5e-4 * (1.0 - rate)}};
    for (std::size_t which = 0; which < distributions.size(); ++which) {
      const auto& [draw, expected] = distributions[which];
      const double least = which == 1 ? -1.0 : 0.0;
      for (unsigned seed = 1; seed <= 200; ++seed) {
        const BoundedMean mean = meanOf(draw, count, least, 1.0, seed);
        CAPTURE(rate, which, seed, mean.mean(count), mean.standardError(count));
        CHECK(std::fabs(mean.mean(count) - expected) < 6.0 * mean.standardError(count));
      }
    }
  }
}

TEST_CASE("where many samples tell a standard error is the usual one, at any scale") {
  const int count = 20'000;
  for (const double scale : {1e-250, 1.0, 1e250}) {
    const Draw draw = [scale](auto& random) { return scale * (2.0 * uniform(random) - 1.0); };
    const double usual = 1.0 / std::sqrt(3.0 * count);
    const BoundedMean mean = meanOf(draw, count, -scale, scale, 5);
    CHECK(mean.standardError(count) / scale > 0.98 * usual);
    CHECK(mean.standardError(count) / scale < 1.1 * usual);
  }
}

TEST_CASE("samples that are all 0 leave what seldom ones may have, and need not be added") {
  for (const double most : {1e-9, 1.0, 40.0}) {
    const BoundedMean nothing(-most, most);
    const BoundedMean zeros = meanOf([](auto&) { return 0.0; }, 1000, -most, most, 1);
    CHECK(nothing.mean(1000.0) == 0.0);
    CHECK(nothing.standardError(1000.0) == zeros.standardError(1000.0));
    CHECK(nothing.standardError(1000.0) > 2e-3 * most);
    CHECK(nothing.standardError(1000.0) < 4e-3 * most);
  }
  CHECK(BoundedMean(0.0, 0.0).standardError(10.0) == 0.0);
}

TEST_CASE("without bounds, or of one sample, no error is known") {
  const double infinity = std::numeric_limits<double>::infinity();
  BoundedMean unbounded(-infinity, infinity);
  unbounded.add(2.0);
  unbounded.add(3.0);
  CHECK(unbounded.mean(2.0) == 2.5);
  CHECK(unbounded.standardError(2.0) == infinity);
  BoundedMean one(-1.0, 1.0);
  one.add(0.5);
  CHECK(one.standardError(1.0) == infinity);
}

TEST_CASE("bounds on a mean fail no more often than told") {
  for (const double rate : {0.01, 0.1, 0.4}) {
    int failed = 0;
    for (unsigned seed = 1; seed <= 1000; ++seed) {
      std::mt19937_64 random(seed);
      MeanBound bound(1.0, 1.0);
      const Draw draw = hits(rate);
      for (int i = 0; i < 100; ++i) bound.add(draw(random));
      const double upper = bound.upper(100.0, 0.05);
      CHECK(upper <= 1.0);
      failed += upper < rate;
    }
    CHECK(failed <= 50);
  }
}
