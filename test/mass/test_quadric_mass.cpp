// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Masses of what quadrics leave of cells, added up over all cells: distributions of Boost.
#include "mass/quadric_mass.h"

#include <array>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <vector>

#include "catch.h"
#include "random_bodies.h"

using namespace fcl_prob;
using namespace fcl_prob::detail;
using namespace fcl_prob_test;

namespace {

// The mass beyond is below 1e-11.
constexpr double kEnd = 7.0;
constexpr double kBeyond = 1e-11;

struct TiledMass {
  Bounds mass{0.0, 0.0};
  double unresolved = 0.0;
};

void addCell(const Cell& cell, const Quadric& quadric, int depth, TiledMass& sum) {
  if (const auto mass = cellQuadricMass(cell, quadric, 0.0, 1e-11)) {
    CHECK(mass->lower <= mass->upper);
    sum.mass.lower += mass->lower;
    sum.mass.upper += mass->upper;
    return;
  }
  if (depth == 0) {
    sum.unresolved += cellMass(cell).upper;
    return;
  }
  for (int corner = 0; corner < 8; ++corner) {
    Cell part = cell;
    for (int k = 0; k < 3; ++k) {
      ((corner >> k & 1) ? part.lo : part.hi)[k] = 0.5 * (cell.lo[k] + cell.hi[k]);
    }
    addCell(part, quadric, depth - 1, sum);
  }
}

// Over cells of unequal widths.
TiledMass tiledMass(const Quadric& quadric, int count, RandomBodies& random) {
  std::array<std::vector<double>, 3> ends;
  for (auto& of_axis : ends) {
    of_axis.push_back(-kEnd);
    for (int i = 1; i < count; ++i) {
      of_axis.push_back(-kEnd + 2 * kEnd * (i + random.uniform(-0.4, 0.4)) / count);
    }
    of_axis.push_back(kEnd);
  }
  TiledMass sum;
  for (int i = 0; i < count * count * count; ++i) {
    const std::size_t place[3] = {static_cast<std::size_t>(i % count),
                                  static_cast<std::size_t>(i / count % count),
                                  static_cast<std::size_t>(i / count / count)};
    Cell cell{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 3};
    for (int k = 0; k < 3; ++k) {
      cell.lo[k] = ends[static_cast<std::size_t>(k)][place[k]];
      cell.hi[k] = ends[static_cast<std::size_t>(k)][place[k] + 1];
    }
    addCell(cell, quadric, 5, sum);
  }
  return sum;
}

// |y - c| <= r in the first `rank` of randomly turned coordinates, c at a distance from 0 there.
Quadric randomQuadric(int rank, double distance, double radius, RandomBodies& random) {
  const Eigen::Matrix3d axes = random.rotation();
  Quadric quadric;
  for (int k = 0; k < rank; ++k) quadric.axes.row(k) = axes.row(k) / radius;
  Eigen::Vector3d towards = Eigen::Vector3d::Zero();
  for (int k = 0; k < rank; ++k) towards[k] = random.uniform(0.1, 1.0);
  quadric.origin = random.uniform(-3.0, 3.0) * random.direction();
  quadric.offset = quadric.axes * quadric.origin - towards.normalized() * (distance / radius);
  return quadric;
}

}  // namespace

TEST_CASE("balls, cylinders and slabs over all cells: noncentral chi-squared distributions") {
  RandomBodies random(61);
  for (const int rank : {3, 2, 1}) {
    for (const double radius : {0.8, 3.0}) {
      const double distance = radius + random.uniform(-1.0, 1.5);
      const Quadric quadric = randomQuadric(rank, distance, radius, random);
      const boost::math::non_central_chi_squared law(rank, distance * distance);
      const double truth = boost::math::cdf(law, radius * radius);
      const TiledMass sum = tiledMass(quadric, 9, random);
      INFO("rank " << rank << ", radius " << radius << ", distance " << distance);
      CAPTURE(truth, sum.mass.lower, sum.mass.upper, sum.unresolved);
      CHECK(sum.unresolved < 1e-3);
      CHECK(sum.mass.lower <= truth * (1 + 1e-11));
      CHECK(sum.mass.upper + sum.unresolved >= truth * (1 - 1e-11) - kBeyond);
      CHECK(sum.mass.upper - sum.mass.lower < 1e-9);
    }
  }
}

TEST_CASE("what slack leaves open of a quadric is in its bounds") {
  RandomBodies random(62);
  const Quadric quadric = randomQuadric(3, 2.0, 2.0, random);
  const Cell cell{Eigen::Vector3d(-0.1, -0.2, -0.1), Eigen::Vector3d(0.2, 0.1, 0.1), 3};
  constexpr double kSlack = 1e-4;
  const auto mass = cellQuadricMass(cell, quadric, kSlack, 1e-11);
  REQUIRE(mass);
  for (const double radius : {1.0 - kSlack, 1.0 + kSlack}) {
    const Quadric moved{quadric.axes / radius, quadric.origin, quadric.offset / radius};
    const auto other = cellQuadricMass(cell, moved, 0.0, 1e-11);
    REQUIRE(other);
    CHECK(other->upper > other->lower);
    CHECK(mass->lower <= other->upper);
    CHECK(mass->upper >= other->lower);
  }
  CHECK(mass->upper - mass->lower < 0.02 * cellMass(cell).upper);
}
