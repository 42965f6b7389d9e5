// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A confidence sequence: looked at after every sample, it fails as rarely as stated.
#include "gaussian/hit_sequence.h"

#include <random>

#include "catch.h"

using fcl_prob::Bounds;
using fcl_prob::detail::HitSequence;

TEST_CASE("however often one looks, a sequence of hits fails no more often than stated") {
  std::mt19937_64 random(3);
  constexpr double kError = 0.05;
  constexpr int kRuns = 400;
  for (const double p : {0.003, 0.3, 0.97}) {
    int failed = 0;
    for (int run = 0; run < kRuns; ++run) {
      HitSequence sequence;
      std::bernoulli_distribution hit(p);
      bool outside = false;
      for (int i = 0; i < 200 && !outside; ++i) {
        sequence.add(hit(random) ? 1 : 0, 1);
        const Bounds bounds = sequence.interval(kError);
        outside = p < bounds.lower || p > bounds.upper;
      }
      failed += outside;
    }
    CAPTURE(p, failed);
    // Four deviations above what is stated.
    CHECK(failed <= kError * kRuns + 4.0 * std::sqrt(kError * kRuns));
  }
}

TEST_CASE("a sequence of hits narrows to the share of hits") {
  HitSequence none;
  CHECK(none.interval(0.01).lower == 0.0);
  CHECK(none.interval(0.01).upper == 1.0);
  HitSequence sequence;
  sequence.add(0, 1'000);
  CHECK(sequence.interval(0.01).lower == 0.0);
  CHECK(sequence.interval(0.01).upper < 0.02);
  CHECK(sequence.interval(1e-6).upper > sequence.interval(0.01).upper);
  sequence.add(250'000, 999'000);
  CHECK(sequence.interval(1e-4).lower > 0.247);
  CHECK(sequence.interval(1e-4).upper < 0.253);
  HitSequence all;
  all.add(50, 50);
  CHECK(all.interval(0.01).upper == 1.0);
  CHECK(all.interval(0.01).lower > 0.8);
}
