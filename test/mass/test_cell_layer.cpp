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
