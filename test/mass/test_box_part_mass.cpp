// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Boxes cut by half-spaces.
#include <Eigen/Geometry>

#include "base/constants.h"
#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/normal_mass.h"
#include "fcl_prob/polytope_mass.h"
#include "high_precision.h"
#include "random_inputs.h"

namespace fcl_prob {
namespace {

using detail::kInfinity;
using Eigen::Vector3d;
using fcl_prob_test::HighPrecision;
using fcl_prob_test::logUniform;
using fcl_prob_test::randomVector;
using fcl_prob_test::trueIntervalMass;
using fcl_prob_test::trueTail;
using fcl_prob_test::uniform;

const Vector3d kEverywhere = Vector3d::Constant(kInfinity);

struct AlignedBox {
  Vector3d lo, hi;

  double mass() const { return normalBoxMass(lo, hi); }
};

// Some sides infinite, some narrow, near or far from the origin.
AlignedBox randomAlignedBox(std::mt19937& random, double farthest) {
  AlignedBox box;
  for (int k = 0; k < 3; ++k) {
    const double middle = uniform(random, -farthest, farthest);
    const double half = logUniform(random, 1e-2, 5);
    box.lo[k] = random() % 6 == 0 ? -kInfinity : middle - half;
    box.hi[k] = random() % 6 == 0 ? kInfinity : middle + half;
  }
  return box;
}

// Through a random point of the box.
HalfSpace randomCut(std::mt19937& random, const AlignedBox& box) {
  HalfSpace h;
  h.normal = randomVector(random);
  if (random() % 4 == 0) h.normal[random() % 3] = 0;
  h.normal.normalize();
  Vector3d point;
  for (int k = 0; k < 3; ++k) {
    point[k] = uniform(random, std::max(box.lo[k], -6.0), std::min(box.hi[k], 6.0));
  }
  h.offset = h.normal.dot(point);
  return h;
}

HalfSpace complement(const HalfSpace& h) { return {-h.normal, -h.offset}; }

bool contains(const Bounds& bounds, const HighPrecision& truth) {
  return HighPrecision(bounds.lower) <= truth && truth <= HighPrecision(bounds.upper);
}

// a + b must be able to be `whole`.
bool mayAddUp(const Bounds& a, const Bounds& b, double whole) {
  return a.lower + b.lower <= whole * (1 + 1e-13) && a.upper + b.upper >= whole * (1 - 1e-13);
}

}  // namespace

TEST_CASE("axis-aligned half-spaces of a box are exact") {
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    const AlignedBox box = randomAlignedBox(random, 4);
    const int axis = i % 3;
    HalfSpace h{Vector3d::Unit(axis), uniform(random, -5, 5)};
    AlignedBox part = box;
    part.lo[axis] = std::max(part.lo[axis], h.offset);
    const Bounds bounds = boxHalfSpaceMass(box.lo, box.hi, h);
    CHECK(bounds.lower <= part.mass());
    CHECK(bounds.upper >= part.mass());
    CHECK(bounds.width() <= 1e-13 * part.mass() + 1e-299);
    CHECK(mayAddUp(bounds, boxHalfSpaceMass(box.lo, box.hi, complement(h)), box.mass()));
  }
}

TEST_CASE("a half-space of everything has the mass of a tail") {
  std::mt19937 random(2);
  for (const double offset : {-3.0, 0.0, 0.5, 2.0, 8.0, 20.0, 36.0}) {
    for (int i = 0; i < 5; ++i) {
      const Vector3d normal = randomVector(random).normalized();
      const Bounds bounds = boxHalfSpaceMass(-kEverywhere, kEverywhere, {normal, offset});
      const HighPrecision truth = trueTail(HighPrecision(offset));
      // The normal is a unit vector to an ulp only.
      const double slack = 1e-15 * (1 + offset * offset);
      CAPTURE(offset, bounds.lower, bounds.upper);
      CHECK(HighPrecision(bounds.lower) <= truth * (1 + slack));
      CHECK(HighPrecision(bounds.upper) >= truth * (1 - slack));
      CHECK(bounds.width() < 1e-9 * bounds.upper);
    }
  }
}

TEST_CASE("both sides of a cut add up to the box") {
  std::mt19937 random(3);
  double widest = 0;
  int tails = 0;
  for (int i = 0; i < 400; ++i) {
    const AlignedBox box = randomAlignedBox(random, i % 2 == 0 ? 2 : 18);
    const double whole = box.mass();
    if (whole < 1e-250) continue;
    const HalfSpace h = randomCut(random, box);
    const Bounds part = boxHalfSpaceMass(box.lo, box.hi, h);
    const Bounds rest = boxHalfSpaceMass(box.lo, box.hi, complement(h));
    CAPTURE(whole, part.lower, part.upper, rest.lower, rest.upper);
    REQUIRE(part.lower <= part.upper);
    REQUIRE(mayAddUp(part, rest, whole));
    widest = std::max(widest, (part.width() + rest.width()) / whole);
    tails += whole < 1e-20;
  }
  CAPTURE(widest);
  CHECK(widest < 1e-8);
  CHECK(tails > 50);
}

TEST_CASE("wedges obey inclusion and exclusion") {
  std::mt19937 random(4);
  double widest = 0;
  for (int i = 0; i < 300; ++i) {
    const AlignedBox box = randomAlignedBox(random, i % 2 == 0 ? 2 : 12);
    const double whole = box.mass();
    if (whole < 1e-250) continue;
    const HalfSpace a = randomCut(random, box);
    HalfSpace b = randomCut(random, box);
    if (i % 10 == 0) b = a;
    if (i % 10 == 1) b = {a.normal, a.offset + 0.1};
    const Bounds both = boxWedgeMass(box.lo, box.hi, a, b);
    const Bounds only_a = boxWedgeMass(box.lo, box.hi, a, complement(b));
    const Bounds in_a = boxHalfSpaceMass(box.lo, box.hi, a);
    CAPTURE(i, whole, both.lower, both.upper, only_a.lower, only_a.upper, in_a.lower, in_a.upper);
    REQUIRE(both.lower + only_a.lower <= in_a.upper);
    REQUIRE(both.upper + only_a.upper >= in_a.lower);
    REQUIRE(both.upper <= in_a.upper * (1 + 1e-9));
    widest = std::max(widest, (both.width() + only_a.width()) / whole);
  }
  CAPTURE(widest);
  CHECK(widest < 1e-7);
}

TEST_CASE("cut boxes against sampling") {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  constexpr int kSamples = 20000;
  for (int i = 0; i < 20; ++i) {
    AlignedBox box = randomAlignedBox(random, 1);
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = std::min(box.lo[k], -0.5);
      box.hi[k] = std::max(box.hi[k], 0.5);
    }
    const HalfSpace a = randomCut(random, box);
    const HalfSpace b = randomCut(random, box);
    int in_half = 0, in_wedge = 0;
    for (int n = 0; n < kSamples; ++n) {
      const Vector3d y(normal(random), normal(random), normal(random));
      if ((y.array() < box.lo.array()).any() || (y.array() > box.hi.array()).any()) continue;
      if (a.normal.dot(y) < a.offset) continue;
      ++in_half;
      in_wedge += b.normal.dot(y) >= b.offset;
    }
    const auto agrees = [&](const Bounds& bounds, int hits) {
      const double p = bounds.middle();
      return std::abs(hits - kSamples * p) <= 5 * std::sqrt(kSamples * p * (1 - p)) + 3;
    };
    CHECK(agrees(boxHalfSpaceMass(box.lo, box.hi, a), in_half));
    CHECK(agrees(boxWedgeMass(box.lo, box.hi, a, b), in_wedge));
  }
}

TEST_CASE("a diagonal cut through the origin halves a symmetric box") {
  for (const double half : {1e-2, 1.0, 10.0}) {
    const Vector3d corner(half, half, half);
    for (const Vector3d& normal : {Vector3d(1, 1, 0), Vector3d(1, -1, 0), Vector3d(0, 1, 1),
                                   Vector3d(1, 1, 1), Vector3d(-1, 1, 1)}) {
      const Bounds bounds = boxHalfSpaceMass(-corner, corner, {normal.normalized(), 0});
      const HighPrecision interval = trueIntervalMass(-half, half);
      CHECK(contains(bounds, interval * interval * interval / 2));
      CHECK(bounds.width() < 1e-11 * bounds.upper);
    }
  }
}

TEST_CASE("half-spaces that miss or contain the box, empty boxes and bad input") {
  const Vector3d lo(1, 2, 3), hi(2, 3, 4);
  const Vector3d normal = Vector3d(1, 2, -2) / 3;
  const double mass = normalBoxMass(lo, hi);
  CHECK(boxHalfSpaceMass(lo, hi, {normal, 100}).upper == 0);
  CHECK(boxHalfSpaceMass(lo, hi, {normal, -100}).middle() == Approx(mass).epsilon(1e-13));
  CHECK(boxHalfSpaceMass(lo, hi, {normal, kInfinity}).upper == 0);
  CHECK(boxHalfSpaceMass(lo, hi, {normal, -kInfinity}).middle() == Approx(mass).epsilon(1e-13));
  CHECK(boxWedgeMass(lo, hi, {normal, -0.5}, {-normal, 1}).upper == 0);
  CHECK(boxHalfSpaceMass(hi, lo, {normal, 0}).upper == 0);
  CHECK(boxHalfSpaceMass(lo, lo, {normal, 0}).upper == 0);
  CHECK_THROWS_AS(boxHalfSpaceMass(lo, hi, {2 * normal, 0}), InvalidGeometry);
  CHECK_THROWS_AS(boxHalfSpaceMass(lo, hi, {normal, std::nan("")}), InvalidGeometry);
  CHECK_THROWS_AS(boxHalfSpaceMass(lo, {1, std::nan(""), 1}, {normal, 0}), InvalidGeometry);
}

}  // namespace fcl_prob
