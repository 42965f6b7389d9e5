// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <cmath>
#include <random>

#include "base/random_words.h"
#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/monte_carlo.h"
#include "sampling/confidence.h"

using namespace fcl_prob;
using namespace fcl_prob::detail;

TEST_CASE("Clopper-Pearson intervals agree with their closed forms and with tables") {
  const Bounds none = clopperPearsonInterval(0, 100, 0.95);
  CHECK(none.lower == 0.0);
  CHECK(none.upper == Approx(1.0 - std::pow(0.025, 0.01)).epsilon(1e-12));
  const Bounds all = clopperPearsonInterval(100, 100, 0.95);
  CHECK(all.lower == Approx(std::pow(0.025, 0.01)).epsilon(1e-12));
  CHECK(all.upper == 1.0);
  const Bounds some = clopperPearsonInterval(10, 100, 0.95);
  CHECK(some.lower == Approx(0.0490047).epsilon(1e-5));
  CHECK(some.upper == Approx(0.1762226).epsilon(1e-5));
  CHECK_THROWS_AS(clopperPearsonInterval(0, 0, 0.95), InvalidRequest);
  CHECK_THROWS_AS(clopperPearsonInterval(2, 1, 0.95), InvalidRequest);
  CHECK_THROWS_AS(clopperPearsonInterval(1, 2, 1.0), InvalidRequest);
}

TEST_CASE("a run that may stop early still covers with its confidence") {
  const double confidence = 0.9;
  const std::size_t samples = 20000;
  for (double p : {0.02, 0.3}) {
    int covered = 0;
    int stopped_early = 0;
    const int runs = 1000;
    std::mt19937_64 generator(5);
    std::bernoulli_distribution hit(p);
    const LookSchedule looks(samples, confidence);
    for (int run = 0; run < runs; ++run) {
      std::size_t done = 0;
      std::size_t hits = 0;
      Bounds interval;
      while (done < samples) {
        const std::size_t look = looks.next(done);
        for (; done < look; ++done) hits += hit(generator);
        interval = clopperPearsonInterval(hits, done, looks.confidenceAt(look));
        if (!interval.contains(1.05 * p)) break;  // a threshold just above p tempts to stop wrongly
      }
      stopped_early += done < samples;
      covered += interval.contains(p);
    }
    INFO("p " << p << ", covered " << covered << ", stopped early " << stopped_early);
    CHECK(covered >= runs * confidence);
    CHECK(stopped_early > runs / 100);
  }
}

TEST_CASE("gamma intervals of equal weights are the exact Poisson intervals") {
  WeightedHits hits;
  for (int i = 0; i < 10; ++i) hits.add(2.0);
  const Bounds interval = gammaInterval(hits, 2.0, 0.95);
  CHECK(interval.lower == Approx(2 * 4.795389).epsilon(1e-6));
  CHECK(interval.upper == Approx(2 * 18.390356).epsilon(1e-6));
  const Bounds none = gammaInterval(WeightedHits(), 3.0, 0.95);
  CHECK(none.lower == 0.0);
  CHECK(none.upper == Approx(-3.0 * std::log(0.025)).epsilon(1e-9));
}

TEST_CASE("gamma intervals of weights whose squares underflow are still intervals") {
  WeightedHits hits;
  for (int i = 0; i < 5; ++i) hits.add(1e-180);
  const Bounds interval = gammaInterval(hits, 1.0, 0.95);
  CHECK(interval.lower == 0.0);
  CHECK(interval.upper == Approx(-std::log(0.025)).epsilon(1e-9));
}

TEST_CASE("gamma intervals of unequal weights cover") {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  int covered = 0;
  const int runs = 4000;
  const int trials = 400;
  for (int run = 0; run < runs; ++run) {
    WeightedHits hits;
    for (int i = 0; i < trials; ++i) {
      const double weight = std::pow(uniform(generator), 3.0);
      if (uniform(generator) < 0.1) hits.add(weight);
    }
    covered += gammaInterval(hits, 1.0, 0.95).contains(trials * 0.1 * 0.25);
  }
  INFO(covered << " of " << runs);
  CHECK(covered >= 0.95 * runs);
  CHECK(covered < runs);
}

TEST_CASE("samples are standard normal and depend on seed, stream, index and block") {
  const int n = 200000;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d outer = Eigen::Matrix3d::Zero();
  Eigen::Index tail = 0;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d y = standardNormalFrom(randomWords({3}, i));
    sum += y;
    outer += y * y.transpose();
    tail += (y.array() > 2.0).count();
  }
  const double error = 4.0 / std::sqrt(n);
  CHECK((sum / n).cwiseAbs().maxCoeff() < error);
  CHECK((outer / n - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1.5 * error);
  const double expected_tail = 3 * n * 0.022750131948179;
  CHECK(std::abs(static_cast<double>(tail) - expected_tail) < 4 * std::sqrt(expected_tail));
  CHECK(randomWords({1}, 5) == randomWords({1}, 5));
  CHECK(randomWords({1}, 5) != randomWords({2}, 5));
  CHECK(randomWords({1, 0}, 5) != randomWords({1, 1}, 5));
  CHECK(randomWords({1}, 5) != randomWords({1}, 6));
  CHECK(randomWords({1}, 5, 0) != randomWords({1}, 5, 1));
  CHECK(uniformFrom(0) > 0.0);
  CHECK(uniformFrom(~std::uint64_t{0}) < 1.0);
}
