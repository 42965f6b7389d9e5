// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/cell_layer.h"

#include <cmath>
#include <limits>

#include "base/constants.h"
#include "catch.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using fcl_prob::detail::Cell;
using fcl_prob::detail::cellHalfSpaceMass;
using fcl_prob::detail::layerBox;
using fcl_prob::detail::lowestBeyond;
using fcl_prob::detail::massNear;

/// A point of the cell, most often on its sides.
Eigen::Vector3d pointIn(RandomBodies& random, const Cell& cell) {
  Eigen::Vector3d y = cell.lo;
  for (int k = 0; k < cell.rank; ++k) {
    const double t = std::clamp(random.uniform(-0.5, 1.5), 0.0, 1.0);
    y[k] = std::clamp(cell.lo[k] + t * (cell.hi[k] - cell.lo[k]), cell.lo[k], cell.hi[k]);
  }
  return y;
}

TEST_CASE("the box around a layer of a cell holds all of it, however the planes lean") {
  RandomBodies random(77);
  int cut_back = 0;
  for (int i = 0; i < 20'000; ++i) {
    Cell cell{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), random.integer(1, 3)};
    Eigen::Vector3d m = random.normalVector();
    for (int k = 0; k < 3; ++k) {
      cell.lo[k] = random.uniform(-9.0, 9.0);
      cell.hi[k] = k < cell.rank ? cell.lo[k] + random.logUniform(1e-9, 4.0) : cell.lo[k];
      if (random.uniform(0.0, 1.0) < 0.3) m[k] *= random.logUniform(1e-12, 1.0);
    }
    m.normalize();
    // In long double, as far as the planes through it go.
    const Eigen::Vector3d y = pointIn(random, cell);
    const auto height = static_cast<double>(m.cast<long double>().dot(y.cast<long double>()));
    const double from = height - random.uniform(0.0, 1.0) * random.logUniform(1e-15, 1.0);
    const double to = height + random.uniform(0.0, 1.0) * random.logUniform(1e-15, 1.0);
    const Cell box = layerBox(cell, m, from, to);
    CAPTURE(i, cell.rank, m.transpose(), y.transpose(), from, to);
    for (int k = 0; k < cell.rank; ++k) {
      REQUIRE(box.lo[k] <= y[k]);
      REQUIRE(box.hi[k] >= y[k]);
      cut_back += box.hi[k] - box.lo[k] < 0.9 * (cell.hi[k] - cell.lo[k]);
    }
  }
  REQUIRE(cut_back > 1000);
}

// Least m·y over the corners of the box beyond the plane, and where its edges cross it, in long
// double: a linear program's optimum is at one of those.
long double lowestOfCorners(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi,
                            const Eigen::Vector3d& m, const Eigen::Vector3d& n, double s) {
  using LongVector = Eigen::Matrix<long double, 3, 1>;
  const LongVector direction = m.cast<long double>(), normal = n.cast<long double>();
  long double lowest = std::numeric_limits<long double>::infinity();
  const auto cornerOf = [&](int index) {
    LongVector corner;
    for (int k = 0; k < 3; ++k) corner[k] = (index >> k) % 2 == 0 ? lo[k] : hi[k];
    return corner;
  };
  for (int i = 0; i < 8; ++i) {
    const LongVector from = cornerOf(i);
    const long double above = normal.dot(from) - s;
    if (above >= 0) lowest = std::min(lowest, direction.dot(from));
    for (int k = 0; k < 3; ++k) {
      const LongVector to = cornerOf(i ^ (1 << k));
      const long double other = normal.dot(to) - s;
      if ((above < 0) == (other < 0)) continue;
      const LongVector crossing = from + above / (above - other) * (to - from);
      lowest = std::min(lowest, direction.dot(crossing));
    }
  }
  return lowest;
}

TEST_CASE("what of a box is beyond a plane reaches no lower than it is said to") {
  RandomBodies random(78);
  int beyond = 0, empty = 0;
  for (int i = 0; i < 50'000; ++i) {
    Eigen::Vector3d lo, hi, m = random.normalVector(), n = random.normalVector();
    for (int k = 0; k < 3; ++k) {
      lo[k] = random.uniform(-9.0, 9.0);
      hi[k] = lo[k] + random.integer(0, 9) * random.logUniform(1e-9, 1.0);
      if (random.integer(0, 4) == 0) m[k] *= random.integer(0, 1) * random.logUniform(1e-12, 1.0);
      if (random.integer(0, 4) == 0) n[k] *= random.integer(0, 1) * random.logUniform(1e-12, 1.0);
    }
    if (m.isZero(0.0)) continue;
    m.normalize();
    n *= random.logUniform(0.01, 100.0);
    const Eigen::Vector3d share(random.uniform(0.0, 1.0), random.uniform(0.0, 1.0),
                                random.uniform(0.0, 1.0));
    const double extent = n.cwiseAbs().dot(hi - lo);
    const double s = n.dot(lo + share.cwiseProduct(hi - lo)) + random.uniform(-0.3, 0.6) * extent;
    // What its users take off for rounding.
    const double rounding = 64 * fcl_prob::detail::kEpsilon * 38.6 * n.cwiseAbs().sum();
    const double lowest = lowestBeyond(lo, hi, m, n, s - rounding);
    const long double truth = lowestOfCorners(lo, hi, m, n, s);
    CAPTURE(i, lo.transpose(), hi.transpose(), m.transpose(), n.transpose(), s);
    REQUIRE(lowest <= truth);
    if (!std::isfinite(truth)) {
      ++empty;
      continue;
    }
    const long double relaxed = lowestOfCorners(lo, hi, m, n, s - 2 * rounding);
    REQUIRE(lowest >= relaxed - 1e-12L);
    beyond += lowest > m.dot((m.array() > 0).select(lo, hi)) + 1e-9;
  }
  CHECK(beyond > 10'000);
  CHECK(empty > 3'000);
}

TEST_CASE("the mass near a plane is no less than that between two") {
  RandomBodies random(79);
  for (int i = 0; i < 3'000; ++i) {
    Cell cell{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), random.integer(1, 3)};
    Eigen::Vector3d m = random.normalVector();
    for (int k = 0; k < cell.rank; ++k) {
      cell.lo[k] = random.uniform(-4.0, 4.0);
      cell.hi[k] = cell.lo[k] + random.logUniform(1e-3, 2.0);
    }
    for (int k = cell.rank; k < 3; ++k) m[k] = 0.0;
    m.normalize();
    const double s = m.dot(pointIn(random, cell));
    const double width = random.logUniform(1e-4, 1.0);
    const double between = cellHalfSpaceMass(cell, m, s - 0.5 * width, 1e-12).lower -
                           cellHalfSpaceMass(cell, m, s + 0.5 * width, 1e-12).upper;
    CAPTURE(i, cell.rank, m.transpose(), s, width);
    REQUIRE(massNear(cell, m, width) >= between);
  }
}

}  // namespace
