// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Parts of cells within several planes: volumes of cut cubes, and bounds on masses.
#include "cells/covered_part.h"

#include <cmath>

#include "catch.h"
#include "fcl_prob/normal_mass.h"
#include "random_bodies.h"

namespace {

using fcl_prob::Bounds;
using fcl_prob::detail::Cell;
using fcl_prob::detail::CoveredPart;
using fcl_prob::detail::CubeCutter;
using fcl_prob::detail::CubePlane;
using fcl_prob::detail::CutCube;
using fcl_prob::detail::Moment;
using fcl_prob::detail::PartMeasure;
using fcl_prob_test::RandomBodies;

CubePlane planeThrough(const Eigen::Vector3d& normal, const Eigen::Vector3d& point) {
  return {normal, normal.dot(point)};
}

Eigen::Vector3d pointOfCube(RandomBodies& random) {
  return {random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
}

Cell randomCell(RandomBodies& random, double width) {
  Cell cell{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), random.integer(1, 3)};
  for (int k = 0; k < cell.rank; ++k) {
    cell.lo[k] = random.uniform(-4, 4);
    cell.hi[k] = cell.lo[k] + width * random.uniform(0.3, 1.0);
  }
  return cell;
}

CoveredPart randomPart(const Cell& cell, RandomBodies& random, int count) {
  CoveredPart part;
  part.count = count;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d m = random.direction();
    const Eigen::Vector3d at =
        cell.lo + (cell.hi - cell.lo)
                      .cwiseProduct(0.2 * pointOfCube(random).array().matrix() +
                                    Eigen::Vector3d::Constant(0.3));
    part.planes[static_cast<std::size_t>(i)] = {m, m.dot(at)};
  }
  return part;
}

bool contains(const CoveredPart& part, const Eigen::Vector3d& y) {
  for (int i = 0; i < part.count; ++i) {
    const auto& plane = part.planes[static_cast<std::size_t>(i)];
    if (plane.m.dot(y) < plane.s) return false;
  }
  return true;
}

// A point of the cell with the density of the normal distribution, by rejection.
Eigen::Vector3d normalPoint(const Cell& cell, RandomBodies& random) {
  Eigen::Vector3d y = Eigen::Vector3d::Zero();
  for (int k = 0; k < cell.rank; ++k) {
    const double nearest = std::max({cell.lo[k], -cell.hi[k], 0.0});
    do {
      y[k] = random.uniform(cell.lo[k], cell.hi[k]);
    } while (random.uniform(0, 1) > std::exp(0.5 * (nearest * nearest - y[k] * y[k])));
  }
  return y;
}

}  // namespace

TEST_CASE("a cube cut in closed form", "[covered]") {
  CubeCutter cutter;
  CHECK(cutter.cut(nullptr, 0)->volume == Approx(1.0).margin(1e-15));
  const CubePlane corner{{-1, -1, -1}, -1};  // x + y + z <= 1
  CHECK(cutter.cut(&corner, 1)->volume == Approx(1.0 / 6).margin(1e-14));
  CHECK(cutter.cut(&corner, 1)->moment.isApprox(Eigen::Vector3d::Constant(1.0 / 24), 1e-13));
  const CubePlane wedge[2] = {{{1, -1, 0}, 0}, {{0, 1, -1}, 0}};  // x >= y >= z
  CHECK(cutter.cut(wedge, 2)->volume == Approx(1.0 / 6).margin(1e-14));
  const CubePlane nothing[2] = {{{1, 0, 0}, 0.6}, {{-1, 0, 0}, -0.4}};
  CHECK(cutter.cut(nothing, 2)->volume == 0.0);
  const CubePlane beyond{{1, 1, 1}, 3.1};
  CHECK(cutter.cut(&beyond, 1)->volume == 0.0);
}

// Also where planes are equal, or nearly: what is torn is told, and the rest adds up.
TEST_CASE("the two sides of a plane add up to what it cuts", "[covered]") {
  RandomBodies random(3);
  CubeCutter cutter;
  int torn = 0;
  for (int i = 0; i < 20000; ++i) {
    const int count = random.integer(0, 3);
    CubePlane planes[5];
    for (int j = 0; j < count; ++j) {
      planes[j] =
          planeThrough(random.logUniform(1e-6, 1.0) * random.direction(), pointOfCube(random));
    }
    CubePlane last = planeThrough(random.direction(), pointOfCube(random));
    if (count > 0 && i % 3 == 0) {
      last = planes[random.integer(0, count - 1)];
      last.a += random.logUniform(1e-18, 1e-8) * last.a.norm() * random.direction();
    }
    const auto whole = cutter.cut(planes, count);
    planes[count] = last;
    const auto above = cutter.cut(planes, count + 1);
    planes[count] = {-last.a, -last.r};
    const auto below = cutter.cut(planes, count + 1);
    if (!whole || !above || !below) {
      ++torn;
      continue;
    }
    CHECK(above->volume + below->volume == Approx(whole->volume).margin(1e-13));
    CHECK((above->moment + below->moment - whole->moment).norm() < 1e-13);
    CHECK(above->volume > -1e-14);
    CHECK(below->volume > -1e-14);
  }
  CHECK(torn < 200);
}

TEST_CASE("masses under one plane are on both sides of the integral", "[covered]") {
  RandomBodies random(4);
  CubeCutter cutter;
  for (int i = 0; i < 3000; ++i) {
    const double width = random.logUniform(1e-3, 1.0);
    const Cell cell = randomCell(random, width);
    const CoveredPart part = randomPart(cell, random, 1);
    const PartMeasure measure(cell);
    const Bounds truth =
        fcl_prob::detail::cellHalfSpaceMass(cell, part.planes[0].m, part.planes[0].s, 1e-11);
    const double whole = fcl_prob::detail::cellMass(cell).upper;
    CAPTURE(width, cell.rank, truth.lower / whole);
    CHECK(measure.countedMass(part, cutter) <= truth.upper);
    CHECK(measure.massAtLeast(part, cutter) <= truth.upper);
    CHECK(measure.massAtMost(part, cutter) >= truth.lower);
    // Bends are of second order in the width, but relative to the cell; what bounds lose is so of
    // the part.
    if (width < 0.1) {
      CHECK(truth.upper - measure.countedMass(part, cutter) <= 8 * width * whole);
      const double far = cell.largestCoordinates().sum();
      const double loss = 3 * (1 + far * far) * width * width + 1e-9;
      CHECK(measure.massAtLeast(part, cutter) >= (1 - loss) * truth.lower - 1e-9 * whole);
      CHECK(measure.massAtMost(part, cutter) <= (1 + loss) * truth.upper + 1e-9 * whole);
    }
  }
}

// Far out, where a density falls by many powers of ten within a cell, down to where it is no
// normal number any more.
TEST_CASE("bounds on parts of cells in the tails hold, too", "[covered]") {
  RandomBodies random(7);
  CubeCutter cutter;
  int positive = 0;
  for (int i = 0; i < 3000; ++i) {
    Cell cell = randomCell(random, random.logUniform(1e-6, 4.0));
    for (int k = 0; k < cell.rank; ++k) {
      const double shift = random.uniform(-30, 30);
      cell.lo[k] += shift;
      cell.hi[k] += shift;
    }
    const CoveredPart part = randomPart(cell, random, 1);
    const PartMeasure measure(cell);
    const Bounds truth =
        fcl_prob::detail::cellHalfSpaceMass(cell, part.planes[0].m, part.planes[0].s, 1e-11);
    CAPTURE(cell.lo.transpose(), cell.hi.transpose(), cell.rank);
    CHECK(measure.massAtLeast(part, cutter) <= truth.upper);
    CHECK(measure.massAtMost(part, cutter) >= truth.lower);
    positive += measure.massAtLeast(part, cutter) > 0.0;
  }
  CHECK(positive > 1000);
}

// Of the parts of a cell that is divided until bounds are much closer to each other.
TEST_CASE("bounds on a cell agree with those on its pieces", "[covered]") {
  RandomBodies random(8);
  CubeCutter cutter;
  constexpr int kPieces = 6;
  for (int i = 0; i < 60; ++i) {
    Cell cell = randomCell(random, random.logUniform(0.1, 2.0));
    const CoveredPart part = randomPart(cell, random, random.integer(2, 5));
    Bounds fine{0.0, 0.0};
    const int pieces[] = {kPieces, cell.rank > 1 ? kPieces : 1, cell.rank > 2 ? kPieces : 1};
    for (int j = 0; j < pieces[0] * pieces[1] * pieces[2]; ++j) {
      const int at[] = {j % pieces[0], j / pieces[0] % pieces[1], j / pieces[0] / pieces[1]};
      Cell piece = cell;
      for (int k = 0; k < cell.rank; ++k) {
        const double step = (cell.hi[k] - cell.lo[k]) / kPieces;
        piece.lo[k] = cell.lo[k] + at[k] * step;
        piece.hi[k] = at[k] + 1 == kPieces ? cell.hi[k] : cell.lo[k] + (at[k] + 1) * step;
      }
      const PartMeasure measure(piece);
      fine.lower += measure.massAtLeast(part, cutter);
      fine.upper += measure.massAtMost(part, cutter);
    }
    const PartMeasure measure(cell);
    CAPTURE(i, fine.lower, fine.upper);
    CHECK(fine.lower <= fine.upper);
    CHECK(fine.upper - fine.lower <= 0.3 * fine.upper + 1e-10);
    CHECK(measure.massAtLeast(part, cutter) <= fine.upper * (1 + 1e-12));
    CHECK(measure.massAtMost(part, cutter) >= fine.lower * (1 - 1e-12));
  }
}

TEST_CASE("masses within several planes hold what is sampled", "[covered]") {
  RandomBodies random(5);
  CubeCutter cutter;
  constexpr int kSamples = 2000;
  int between = 0;
  for (int i = 0; i < 300; ++i) {
    const Cell cell = randomCell(random, random.logUniform(0.01, 1.0));
    const CoveredPart part = randomPart(cell, random, random.integer(2, 5));
    const PartMeasure measure(cell);
    int hits = 0;
    int counted = 0;
    for (int j = 0; j < kSamples; ++j) {
      const Eigen::Vector3d y = normalPoint(cell, random);
      const bool contained = contains(part, y);
      hits += contained;
      counted += measure.counts(part, y);
      CHECK((contained || !measure.counts(part, y)));
    }
    const double whole = fcl_prob::detail::cellMass(cell).lower;
    const double in_subset = measure.countedMass(part, cutter) / whole;
    const double least = measure.massAtLeast(part, cutter) / whole;
    const double most = measure.massAtMost(part, cutter) / whole;
    const double error = 5 * std::sqrt((hits + 1.0) * (kSamples - hits + 1.0) / kSamples) + 5;
    CAPTURE(i, least, most, hits);
    CHECK(hits >= least * kSamples - error);
    CHECK(hits <= most * kSamples + error);
    CHECK(std::fabs(counted - in_subset * kSamples) <= error);
    between += hits > 100 && hits < kSamples - 100;
  }
  CHECK(between > 60);
}

TEST_CASE("the moment of a part is that of what its mass counts", "[covered]") {
  CubeCutter cutter;
  RandomBodies random(6);
  for (int i = 0; i < 200; ++i) {
    const double lo = random.uniform(0, 3), hi = lo + random.uniform(0.01, 0.5);
    const Cell cell{{lo, -0.4, 0.2}, {hi, 0.3, 0.6}, 3};
    // Where y > 0 the curve is below its chord: nothing is lost with a plane that looks down.
    CoveredPart part;
    part.count = 1;
    const double share = random.uniform(0.1, 0.9);
    part.planes[0] = {{-1, 0, 0}, -(lo + share * (hi - lo))};
    const PartMeasure measure(cell);
    const double rest =
        fcl_prob::normalIntervalMass(-0.4, 0.3) * fcl_prob::normalIntervalMass(0.2, 0.6);
    const double whole = fcl_prob::normalIntervalMass(lo, hi) * rest;
    CHECK(measure.countedMass(part, cutter) == Approx(share * whole).epsilon(1e-9));
    // ∫ y φ over the lowest part of [lo, hi] that has this share of the mass.
    double y = lo;
    for (double step = hi - lo; step > 1e-14; step *= 0.5) {
      if (fcl_prob::normalIntervalMass(lo, y + step) <= share * whole / rest) y += step;
    }
    const auto density = [](double x) { return 0.39894228040143267794 * std::exp(-0.5 * x * x); };
    const Moment moment = measure.moment(part, cutter);
    CHECK(std::fabs(moment.value[0] - rest * (density(lo) - density(y))) <= moment.error);
    CHECK(moment.error < 0.2 * whole);
  }
}
