// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Bounds by bets: looked at after every sample, they fail as rarely as stated.
#include "gaussian/bet_sequence.h"

#include <cmath>
#include <functional>
#include <random>

#include "catch.h"

using fcl_prob::detail::BetSequence;

namespace {

/// Samples of [0, 1], and their mean.
struct Kind {
  double mean;
  std::function<double(double)> sample;  ///< of a uniform number
};

const Kind kKinds[] = {
    {0.5, [](double u) { return u; }},
    {0.02, [](double u) { return u < 0.02 ? 1.0 : 0.0; }},
    {0.104, [](double u) { return u < 0.005 ? 0.9 : 0.1; }},
    {0.3, [](double) { return 0.3; }},
    {1.0 / 21.0, [](double u) { return std::pow(u, 20.0); }},
};

}  // namespace

TEST_CASE("however often one looks, bets on a mean are lost no more often than stated") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  constexpr double kError = 0.05;
  constexpr int kRuns = 400;
  for (const Kind& kind : kKinds) {
    for (const double target : {1.05 * kind.mean, 1.5 * kind.mean}) {
      int failed = 0;
      for (int run = 0; run < kRuns; ++run) {
        // What is expected is wrong in most runs.
        BetSequence bets(kind.mean * (0.5 + run % 3 * 0.5), 0.05);
        bool is_wrong = false;
        for (int i = 0; i < 150 && !is_wrong; ++i) {
          // Bounds that are not the same all along.
          const double most = 1.0 + i % 2;
          const double stake = bets.stakeFor(target, most);
          bets.add(kind.sample(uniform(random)), most, stake);
          if (i == 40) bets.changeKind();
          is_wrong = bets.upper(kError, 1.0) < kind.mean;
        }
        failed += is_wrong;
      }
      CAPTURE(kind.mean, target, failed);
      CHECK(failed <= kError * kRuns + 4.0 * std::sqrt(kError * kRuns));
    }
  }
}

TEST_CASE("bets tell a mean from a target, about when they say so") {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const Kind& kind : kKinds) {
    BetSequence bets(kind.mean, 0.3);
    const double target = 1.2 * kind.mean;
    CHECK(bets.upper(1e-4, 1.0) == 1.0);
    int samples = 0;
    while (bets.upper(1e-4, 1.0) > target && samples < 100'000) {
      bets.add(kind.sample(uniform(random)), 1.0, bets.stakeFor(target, 1.0));
      ++samples;
    }
    CAPTURE(kind.mean, samples);
    CHECK(samples < 100'000);
    CHECK(bets.upper(1e-4, 1.0) > kind.mean);
    CHECK(bets.upper(1e-8, 1.0) > bets.upper(1e-4, 1.0));
    CHECK(bets.samplesToTell(target, 1.0, 1e-4) < 0.2 * samples);
    CHECK(bets.samplesToTell(target, 1.0, 1e-8) > 0.2 * samples);
  }
}
