// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Masses of cells under a plane, against 50 digits, and against polytopes'.
#include "mass/cell_mass.h"

#include <cmath>
#include <vector>

#include "catch.h"
#include "fcl_prob/convex_polytope.h"
#include "fcl_prob/polytope_mass.h"
#include "high_precision.h"
#include "random_bodies.h"

using namespace fcl_prob;
using namespace fcl_prob::detail;
using namespace fcl_prob_test;

namespace {

constexpr double kAccuracy = 1e-16;

void setInterval(double middle, double width, int axis, Cell& cell) {
  cell.lo[axis] = middle - 0.5 * width;
  cell.hi[axis] = middle + 0.5 * width;
}

void checkHolds(const Bounds& bounds, const HighPrecision& truth) {
  CAPTURE(bounds.lower, bounds.upper, truth);
  CHECK(HighPrecision(bounds.lower) <= truth);
  CHECK(HighPrecision(bounds.upper) >= truth);
}

// The corners of a cell on one side of a plane, and where its edges cross that.
std::vector<Eigen::Vector3d> cornersAbove(const Cell& cell, const Eigen::Vector3d& m, double s) {
  const auto corner = [&](int bits) {
    Eigen::Vector3d at;
    for (int k = 0; k < 3; ++k) at[k] = (bits >> k & 1) != 0 ? cell.hi[k] : cell.lo[k];
    return at;
  };
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 8; ++i) {
    const double of_i = m.dot(corner(i)) - s;
    if (of_i >= 0) points.push_back(corner(i));
    for (int k = 0; k < 3; ++k) {
      const int j = i | 1 << k;
      const double of_j = m.dot(corner(j)) - s;
      if (j == i || of_i * of_j >= 0) continue;
      points.push_back(corner(i) + of_i / (of_i - of_j) * (corner(j) - corner(i)));
    }
  }
  return points;
}

}  // namespace

TEST_CASE("a plane across one axis leaves a product of masses, however far out the others are") {
  RandomBodies random(31);
  for (int i = 0; i < 2000; ++i) {
    INFO("cell " << i);
    const int axis = random.integer(0, 2);
    Cell cell{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 3};
    HighPrecision truth = 1;
    for (int k = 0; k < 3; ++k) {
      const double reach = k == axis ? 1.0 : 25.0;
      const double width = k == axis ? random.uniform(1.0, 2.5) : random.logUniform(1e-4, 0.1);
      setInterval(random.uniform(-reach, reach), width, k, cell);
      if (k != axis) truth *= trueIntervalMass(cell.lo[k], cell.hi[k]);
    }
    const double s = random.uniform(cell.lo[axis], cell.hi[axis]);
    truth *= trueIntervalMass(s, cell.hi[axis]);
    checkHolds(cellHalfSpaceMass(cell, Eigen::Vector3d::Unit(axis), s, kAccuracy), truth);
  }
}

TEST_CASE("an oblique plane within a narrow cell far out: the mass is within its bounds") {
  // So narrow that the density is its value in the middle and a slope, to 20 digits and more: the
  // mass above a plane through the cell is an integral of those over a part of a box.
  RandomBodies random(32);
  for (int i = 0; i < 2000; ++i) {
    INFO("cell " << i);
    Cell cell{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 2};
    const double width = random.logUniform(1e-9, 1e-7);
    Eigen::Vector3d m(random.uniform(0.5, 1.0), random.uniform(-0.25, 0.25), 0.0);
    m.normalize();
    for (int k = 0; k < 2; ++k) setInterval(random.uniform(-25.0, 25.0), width, k, cell);
    const Eigen::Vector3d middle = 0.5 * (cell.lo + cell.hi);
    const double s = m.dot(middle) + 0.1 * width * random.uniform(-1.0, 1.0);
    // x = y - middle; along x0 what is kept starts at l - (m1/m0) x1, within the cell.
    const HighPrecision y0 = middle.x(), y1 = middle.y(), m0 = m.x(), m1 = m.y();
    const HighPrecision l = (HighPrecision(s) - m0 * y0 - m1 * y1) / m0, b = m1 / m0;
    const HighPrecision lo1 = HighPrecision(cell.lo.y()) - y1,
                        hi1 = HighPrecision(cell.hi.y()) - y1;
    const HighPrecision hi0 = HighPrecision(cell.hi.x()) - y0;
    const auto power = [&](int n) { return (pow(hi1, n) - pow(lo1, n)) / n; };
    // ∫ over x1 of ∫ over x0 of 1 - y0 x0 - y1 x1
    const HighPrecision area = (hi0 - l) * power(1) + b * power(2);
    const HighPrecision first =
        (hi0 * hi0 - l * l) / 2 * power(1) + l * b * power(2) - b * b / 2 * power(3);
    const HighPrecision second = (hi0 - l) * power(2) + b * power(3);
    const HighPrecision density =
        exp(-(y0 * y0 + y1 * y1) / 2) / (2 * boost::math::constants::pi<HighPrecision>());
    const HighPrecision truth = density * (area - y0 * first - y1 * second);
    Bounds bounds = cellHalfSpaceMass(cell, m, s, kAccuracy);
    const double left_out = 1000.0 * width * width * bounds.upper;  // of the density
    checkHolds({bounds.lower - left_out, bounds.upper + left_out}, truth);
  }
}

TEST_CASE("an oblique plane in a narrow cell leaves the mass of a polytope") {
  RandomBodies random(33);
  for (int i = 0; i < 500; ++i) {
    Cell cell{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 3};
    for (int k = 0; k < 3; ++k) {
      setInterval(random.uniform(-4.0, 4.0), random.logUniform(0.02, 0.8), k, cell);
    }
    const Eigen::Vector3d m = random.direction();
    Eigen::Vector3d inside;
    for (int k = 0; k < 3; ++k) {
      inside[k] = cell.lo[k] + random.uniform(0.2, 0.8) * (cell.hi[k] - cell.lo[k]);
    }
    const double s = m.dot(inside);
    const Bounds truth = polytopeMass(convexHull(cornersAbove(cell, m, s)), 1e-14);
    const double whole = cellMass(cell).upper;
    CAPTURE(i, truth.lower, truth.upper, whole);
    REQUIRE(truth.width() < 1e-6 * whole);
    for (const double accuracy : {1e-3, 1e-5, 1e-11}) {
      const Bounds mass = cellHalfSpaceMass(cell, m, s, accuracy);
      CAPTURE(accuracy, mass.lower, mass.upper);
      CHECK(mass.lower <= truth.upper);
      CHECK(mass.upper >= truth.lower);
      CHECK(mass.width() < 4 * accuracy * whole);
    }
  }
}
