// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/normal_mass.h"

#include <limits>
#include <random>

#include "base/constants.h"
#include "catch.h"
#include "high_precision.h"

using fcl_prob_test::HighPrecision;
using fcl_prob_test::relativeError;
using fcl_prob_test::trueIntervalMass;
using fcl_prob_test::trueTail;

namespace fcl_prob {
namespace {

using detail::kInfinity;

HighPrecision densityAt(double h) {
  const HighPrecision pi = boost::math::constants::pi<HighPrecision>();
  return exp(-HighPrecision(h) * h / 2) / sqrt(2 * pi);
}

double randomWidth(std::mt19937& random) {
  return std::pow(10.0, std::uniform_real_distribution<double>(-12, 1.5)(random));
}

}  // namespace

TEST_CASE("tail mass keeps a few ulp from the middle to the last normal double") {
  std::mt19937 random(1);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const double h = std::uniform_real_distribution<double>(-10, 37.5)(random);
    worst = std::max(worst, relativeError(normalTailMass(h), trueTail(HighPrecision(h))));
  }
  CAPTURE(worst);
  CHECK(worst < 6 * std::numeric_limits<double>::epsilon());
  CHECK(normalTailMass(0) == 0.5);
  CHECK(normalTailMass(kInfinity) == 0);
  CHECK(normalTailMass(-kInfinity) == 1);
  CHECK(normalTailMass(1e300) == 0);
}

TEST_CASE("interval mass keeps its stated accuracy for any width, on both sides, into the tails") {
  std::mt19937 random(3);
  double worst = 0;
  int narrow = 0, wide = 0, tail = 0, straddling = 0;
  for (int i = 0; i < 4000; ++i) {
    const double lo =
        std::uniform_real_distribution<double>(-37, 37)(random) / (i % 3 == 0 ? 1.0 : 10.0);
    const double hi = lo + randomWidth(random);
    if (!(lo < hi)) continue;
    const HighPrecision truth = trueIntervalMass(lo, hi);
    if (truth < 1e-300) continue;
    worst = std::max(worst, relativeError(normalIntervalMass(lo, hi), truth));
    narrow += hi - lo < 1e-6;
    wide += hi - lo > 1;
    tail += truth < 1e-100;
    straddling += lo < 0 && hi > 0;
  }
  CAPTURE(worst);
  CHECK(worst < kIntervalMassRelativeError);
  CHECK(narrow > 300);
  CHECK(wide > 60);
  CHECK(tail > 60);
  CHECK(straddling > 30);
}

TEST_CASE("interval mass is continuous in accuracy across its branches") {
  std::mt19937 random(4);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const double middle = std::pow(10.0, std::uniform_real_distribution<double>(-2, 1.5)(random));
    const double width =
        std::min(0.5, 0.7 / middle) * std::uniform_real_distribution<double>(0.9, 1.1)(random);
    const double lo = middle - width / 2;
    const double hi = middle + width / 2;
    worst = std::max(worst, relativeError(normalIntervalMass(lo, hi), trueIntervalMass(lo, hi)));
  }
  CAPTURE(worst);
  CHECK(worst < kIntervalMassRelativeError);
}

TEST_CASE("interval mass of infinite, empty and mirrored intervals") {
  CHECK(normalIntervalMass(-kInfinity, kInfinity) == 1);
  CHECK(normalIntervalMass(0, kInfinity) == 0.5);
  CHECK(normalIntervalMass(-kInfinity, 0) == 0.5);
  CHECK(normalIntervalMass(kInfinity, kInfinity) == 0);
  CHECK(normalIntervalMass(3, kInfinity) == normalTailMass(3));
  CHECK(normalIntervalMass(-kInfinity, -3) == normalTailMass(3));
  CHECK(normalIntervalMass(1, 1) == 0);
  CHECK(normalIntervalMass(2, 1) == 0);
  CHECK(std::isnan(normalIntervalMass(std::nan(""), 1)));
  std::mt19937 random(5);
  for (int i = 0; i < 1000; ++i) {
    const double lo = std::uniform_real_distribution<double>(-10, 10)(random);
    const double hi = lo + randomWidth(random);
    CHECK(normalIntervalMass(lo, hi) == normalIntervalMass(-hi, -lo));
  }
}

TEST_CASE("interval moment is the difference of the densities without its cancellation") {
  std::mt19937 random(6);
  double worst = 0;
  int cancelling = 0;
  for (int i = 0; i < 2000; ++i) {
    const double lo = std::uniform_real_distribution<double>(-37, 37)(random);
    const double hi = lo + randomWidth(random);
    if (!(lo < hi)) continue;
    const HighPrecision at_lo = densityAt(lo);
    const HighPrecision at_hi = densityAt(hi);
    const HighPrecision truth = at_lo - at_hi;
    if (abs(truth) < 1e-300) continue;
    worst = std::max(worst, relativeError(normalIntervalMoment(lo, hi), truth));
    cancelling += abs(truth) < 1e-3 * std::max(at_lo, at_hi);
  }
  CAPTURE(worst);
  CHECK(worst < kIntervalMassRelativeError);
  CHECK(cancelling > 250);
  CHECK(normalIntervalMoment(-2, 2) == 0);
  CHECK(normalIntervalMoment(-kInfinity, kInfinity) == 0);
  CHECK(normalIntervalMoment(-kInfinity, 1) == -normalIntervalMoment(-1, kInfinity));
  CHECK(normalIntervalMoment(0, kInfinity) == Approx(0.3989422804014327).epsilon(1e-15));
}

TEST_CASE("box mass is the product of its intervals") {
  const Eigen::Vector3d lo(-1, 5, 20), hi(kInfinity, 5.001, 22);
  const HighPrecision truth = trueIntervalMass(lo.x(), hi.x()) * trueIntervalMass(lo.y(), hi.y()) *
                              trueIntervalMass(lo.z(), hi.z());
  CHECK(relativeError(normalBoxMass(lo, hi), truth) < 3 * kIntervalMassRelativeError);
}

}  // namespace fcl_prob
