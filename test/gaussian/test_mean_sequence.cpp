// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Intervals of means fail as rarely as stated for every distribution; standard errors count what no
// sample shows.
#include "gaussian/mean_sequence.h"

#include <boost/math/distributions/poisson.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "catch.h"

using fcl_prob::Bounds;
using fcl_prob::detail::MeanSequence;

namespace {

/// Samples of a range, and their mean.
struct BoundedKind {
  Bounds range;
  double mean;
  std::function<double(double)> sample;  ///< of a uniform number
};

const BoundedKind kBoundedKinds[] = {
    {{0.0, 1.0}, 0.5, [](double u) { return u; }},
    {{0.0, 1.0}, 0.02, [](double u) { return u < 0.02 ? 1.0 : 0.0; }},
    {{0.0, 1.0}, 0.995, [](double u) { return u < 0.005 ? 0.0 : 1.0; }},
    {{0.0, 1.0}, 0.3, [](double) { return 0.3; }},
    {{-2.0, 2.0}, 0.01, [](double u) { return u < 0.02   ? 1.5
                                              : u < 0.04 ? -1.0
                                                         : 0.0; }},
    {{-2.0, 2.0}, -0.004, [](double u) { return u < 0.002 ? -2.0 : 0.0; }},
};

}  // namespace

TEST_CASE("intervals of a mean fail no more often than stated, however often one looks") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  constexpr double kError = 0.05;
  constexpr int kRuns = 300;
  for (const BoundedKind& kind : kBoundedKinds) {
    for (const double away : {0.1, 0.5}) {
      int failed = 0;
      for (int run = 0; run < kRuns; ++run) {
        MeanSequence sequence(kind.range, 1.0, 0.0, 0.1 + 0.2 * (run % 3));
        bool is_wrong = false;
        for (int look = 0, size = 16; look < 8 && !is_wrong; ++look, size *= 2) {
          const double gap = away * std::fabs(kind.mean);
          sequence.aim(sequence.mean() - gap, sequence.mean() + gap);
          double zeros = 0.0;
          for (int i = 0; i < size; ++i) {
            const double x = kind.sample(uniform(random));
            if (x == 0.0) {
              zeros += 1.0;
            } else {
              sequence.add(x);
            }
          }
          sequence.add({0.0, 0.0}, zeros);
          is_wrong = !sequence.interval(kError).contains(kind.mean);
        }
        failed += is_wrong ? 1 : 0;
      }
      CAPTURE(kind.mean, away, failed);
      CHECK(failed <= kError * kRuns + 4.0 * std::sqrt(kError * kRuns));
    }
  }
}

TEST_CASE("an interval closes in on the mean, and on both of its sides") {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const BoundedKind& kind : kBoundedKinds) {
    MeanSequence sequence(kind.range, 1.0, 0.0, 0.3);
    for (int look = 0; look < 11; ++look) {
      const double away = look == 0 ? 1.0 : 4.0 * sequence.standardError();
      sequence.aim(sequence.mean() - away, sequence.mean() + away);
      for (int i = 0; i < 16 << look; ++i) sequence.add(kind.sample(uniform(random)));
    }
    const Bounds interval = sequence.interval(1e-4);
    CAPTURE(kind.mean, interval.lower, interval.upper, sequence.count());
    CHECK(interval.contains(kind.mean));
    CHECK(interval.width() < 20.0 * sequence.standardError());
  }
}

TEST_CASE("samples that are known only between two ends widen both interval and error") {
  MeanSequence exact({0.0, 1.0}, 0.5, 0.5, 0.3), vague({0.0, 1.0}, 0.5, 0.5, 0.3);
  for (int i = 0; i < 400; ++i) {
    const double x = 0.3 + 0.001 * (i % 7);
    exact.add(x);
    vague.add({x - 0.05, x + 0.05}, 1.0);
  }
  CHECK(std::fabs(vague.mean() - exact.mean()) < 1e-9);
  CHECK(vague.standardError() >= exact.standardError() + 0.0499);
  CHECK(vague.interval(0.01).lower < exact.interval(0.01).lower - 0.04);
  CHECK(vague.interval(0.01).upper > exact.interval(0.01).upper + 0.04);
}

TEST_CASE("six standard errors hold the mean of rare hits, whatever it is") {
  const double samples = 1e7;
  for (double mean = 0.01; mean < 3000.0; mean *= 1.1) {
    const boost::math::poisson_distribution<double> hits(mean);
    double missed = 0.0;
    const double reach = 12.0 * std::sqrt(mean) + 40.0;
    for (double k = std::max(0.0, std::floor(mean - reach)); k <= mean + reach; k += 1.0) {
      MeanSequence sequence({0.0, 1.0}, 1.0, 0.0, 0.1);
      sequence.add({1.0, 1.0}, k);
      sequence.add({0.0, 0.0}, samples - k);
      const double off = std::fabs(k - mean) / samples;
      if (off > 6.0 * sequence.standardError()) missed += boost::math::pdf(hits, k);
    }
    CAPTURE(mean, missed);
    CHECK(missed < 1e-5);
  }
}
