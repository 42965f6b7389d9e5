// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The planes between which the boundary of a C-obstacle lies within a cell.
#include "convex/cell_section.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "catch.h"
#include "convex/portal.h"
#include "random_bodies.h"
#include "shapes.h"

using namespace fcl_prob::detail;
using namespace fcl_prob_test;

namespace {

// A direction in which a point is outside of V by the most, found by random search: max over n of
// n·y - h(n). Independent of portals. Positive: certainly outside.
double excess(const SupportObstacle& obstacle, const Eigen::Vector3d& y, RandomBodies& random) {
  Eigen::Vector3d best = (y - obstacle.centre()).normalized();
  const auto value = [&](const Eigen::Vector3d& n) { return n.dot(y) - obstacle.supportUpper(n); };
  double highest = value(best);
  double step = 1.0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d n = (best + step * random.direction()).normalized();
    if (value(n) > highest) {
      highest = value(n);
      best = n;
    } else {
      step *= 0.93;
    }
  }
  return highest;
}

// A point of the cube from -1 to 1.
Eigen::Vector3d insideCube(RandomBodies& random) {
  const double x = random.uniform(-1.0, 1.0);
  const double y = random.uniform(-1.0, 1.0);
  return {x, y, random.uniform(-1.0, 1.0)};
}

struct Counts {
  int outside = 0;
  int inside = 0;
  int with_inner = 0;
  int cells = 0;
  double gap = 0.0;  // between the planes, in widths of the cell, summed
};

// Checks the section of one cell on random points of it; returns whether it has an inner plane.
void checkSection(const SupportObstacle& obstacle, const Eigen::Vector3d& middle,
                  const Eigen::Vector3d& half, RandomBodies& random, Counts& counts) {
  const CellSection section = sectionOf(obstacle, middle - half, middle + half, 3);
  ++counts.cells;
  counts.outside += section.relation == CellSection::Relation::outside;
  counts.inside += section.relation == CellSection::Relation::inside;
  const double lowest = section.normal.dot(middle) - section.normal.cwiseAbs().dot(half);
  const bool has_inner = section.relation == CellSection::Relation::cut && section.inner > lowest;
  counts.with_inner += has_inner;
  if (has_inner) counts.gap += (section.outer - section.inner) / half.maxCoeff();
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d point = middle + half.cwiseProduct(insideCube(random));
    const double along = section.normal.dot(point);
    const bool claimed_inside =
        section.relation == CellSection::Relation::inside || (has_inner && along <= section.inner);
    const bool claimed_outside =
        section.relation == CellSection::Relation::outside ||
        (!section.normal.isZero(0.0) && section.relation == CellSection::Relation::cut &&
         along > section.outer);
    const double out = excess(obstacle, point, random);
    if (claimed_inside) REQUIRE(out <= 0.0);
    if (claimed_outside) REQUIRE_FALSE(contains(obstacle, point));
    // contains() itself, away from the boundary that the search finds only roughly.
    if (out > 1e-9) REQUIRE_FALSE(contains(obstacle, point));
  }
}

}  // namespace

TEST_CASE("what a section claims holds at random points of the cell, for every pair of shapes") {
  RandomBodies random(11);
  Counts counts;
  const auto shapes = boundedShapes();
  for (const NamedGeometry& a : shapes) {
    for (const NamedGeometry& b : shapes) {
      INFO(a.name << " and " << b.name);
      const Eigen::Matrix3d whitening = Eigen::Vector3d(3, 10, 30).asDiagonal();
      const SupportShape of_a =
          supportShape(*a.geometry).transformed(whitening * random.rotation());
      const SupportShape of_b =
          supportShape(*b.geometry).transformed(whitening * random.rotation());
      const SupportObstacle obstacle({of_a, random.direction()}, {of_b, random.direction()},
                                     Eigen::Vector3d::Constant(1e-13));
      for (int i = 0; i < 12; ++i) {
        const double width = random.logUniform(1e-3, 0.5);
        const Eigen::Vector3d half(width * (1.2 + random.uniform(-1.0, 1.0)), width, width);
        const Eigen::Vector3d touching = obstacle.supportPoint(random.direction());
        const Eigen::Vector3d middle = touching + 1.5 * half.cwiseProduct(insideCube(random));
        checkSection(obstacle, middle, half, random, counts);
      }
    }
  }
  CHECK(counts.outside > 0.05 * counts.cells);
  CHECK(counts.inside > 0.001 * counts.cells);
  CHECK(counts.with_inner > 0.2 * counts.cells);
}

TEST_CASE("on a smooth boundary the planes close up with the square of the cell's width") {
  RandomBodies random(12);
  const auto shapes = boundedShapes();
  const Eigen::Matrix3d whitening = Eigen::Vector3d(3, 10, 30).asDiagonal();
  const SupportShape sphere = supportShape(*shapes[1].geometry).transformed(whitening);
  const SupportShape ellipsoid =
      supportShape(*shapes[2].geometry).transformed(whitening * random.rotation());
  const SupportShape capsule =
      supportShape(*shapes[3].geometry).transformed(whitening * random.rotation());
  for (const SupportShape* second : {&sphere, &ellipsoid, &capsule}) {
    const SupportObstacle obstacle({sphere, Eigen::Vector3d::Zero()},
                                   {*second, Eigen::Vector3d(3, 2, 1)},
                                   Eigen::Vector3d::Constant(1e-13));
    double gap_before = std::numeric_limits<double>::infinity();
    for (const double width : {0.1, 0.02, 0.004}) {
      Counts counts;
      for (int i = 0; i < 100; ++i) {
        const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * width);
        const Eigen::Vector3d middle = obstacle.supportPoint(random.direction());
        checkSection(obstacle, middle, half, random, counts);
      }
      const double gap = counts.gap / counts.with_inner;
      INFO("width " << width << " gap " << gap);
      CHECK(counts.with_inner > 90);
      CHECK(gap < 0.35 * gap_before);  // relative to the width: 0.2 expected
      gap_before = gap;
    }
  }
}

TEST_CASE("cells of lower rank have sections too") {
  RandomBodies random(13);
  const auto shapes = boundedShapes();
  const SupportShape sphere = supportShape(*shapes[1].geometry);
  const SupportObstacle ball({sphere, Eigen::Vector3d::Zero()},
                             {sphere, Eigen::Vector3d(0, 0, 0.6)},
                             Eigen::Vector3d::Constant(1e-15));
  // The unit ball around (0, 0, 0.6) meets the plane z = 0 in the circle of radius 0.8.
  const CellSection cut = sectionOf(ball, {0.75, -0.05, 0}, {0.85, 0.05, 0}, 2);
  REQUIRE(cut.relation == CellSection::Relation::cut);
  CHECK(cut.normal.dot(Eigen::Vector3d(0.8, 0, 0)) == Approx(cut.outer).margin(0.01));
  CHECK(cut.normal.dot(Eigen::Vector3d(0.8, 0, 0)) == Approx(cut.inner).margin(0.01));
  CHECK(sectionOf(ball, {0.7, -0.05, 0}, {0.75, 0.05, 0}, 2).relation ==
        CellSection::Relation::inside);
  CHECK(sectionOf(ball, {0.85, -0.05, 0}, {0.9, 0.05, 0}, 2).relation ==
        CellSection::Relation::outside);
  CHECK(sectionOf(ball, {0.5, 0, 0}, {0.79, 0, 0}, 1).relation == CellSection::Relation::inside);
  CHECK(sectionOf(ball, {0.81, 0, 0}, {0.9, 0, 0}, 1).relation == CellSection::Relation::outside);
}

TEST_CASE("a portal is found in nearly every direction, also below an apex or a corner") {
  RandomBodies random(14);
  const Eigen::Matrix3d whitening = Eigen::Vector3d(3, 10, 30).asDiagonal();
  const auto shapes = boundedShapes();
  int rays = 0, missed = 0;
  for (const NamedGeometry& a : shapes) {
    for (const NamedGeometry& b : shapes) {
      for (int i = 0; i < 30; ++i) {
        const SupportShape of_a =
            supportShape(*a.geometry).transformed(whitening * random.rotation());
        const SupportShape of_b =
            supportShape(*b.geometry).transformed(whitening * random.rotation());
        const SupportObstacle obstacle({of_a, random.direction()}, {of_b, random.direction()},
                                       Eigen::Vector3d::Constant(1e-13));
        for (int j = 0; j < 10; ++j) {
          missed += !Portal(obstacle, obstacle.centre(), random.direction()).found();
          ++rays;
        }
      }
    }
  }
  CHECK(rays == 19200);
  CHECK(missed <= 3);
}
