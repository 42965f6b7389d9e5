// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The slab kernels: what they promise of single triangle pairs, and that all builds agree.
#include <array>
#include <cmath>
#include <vector>

#include "catch.h"
#include "convex/slab_kernels.h"
#include "random_bodies.h"

namespace {

using fcl_prob::detail::CellBox;
using fcl_prob::detail::CellCut;
using fcl_prob::detail::CellRelation;
using fcl_prob::detail::CellSlice;
using fcl_prob::detail::kSlabFields;
using fcl_prob::detail::kTriangleSlabs;
using fcl_prob::detail::PointArrays;
using fcl_prob::detail::SlabArrays;
using fcl_prob::detail::slabKernels;

constexpr double kNoError[3] = {0.0, 0.0, 0.0};

struct TrianglePair {
  std::array<double, 9> a, b;
  std::array<double, kSlabFields * kTriangleSlabs> data;
  SlabArrays slabs() const { return {data.data(), kTriangleSlabs}; }
};

TrianglePair randomPair(fcl_prob_test::RandomBodies& random, double size) {
  TrianglePair pair;
  const Eigen::Vector3d at = random.uniform(0.0, 3.0) * random.direction();
  for (std::size_t i = 0; i < 9; ++i) {
    pair.a[i] = size * random.normal();
    pair.b[i] = size * random.normal() + at[static_cast<int>(i % 3)];
  }
  slabKernels().triangleSlabs(pair.a.data(), pair.b.data(), kNoError, pair.data.data());
  return pair;
}

// A point b - a with random weights of the corners: certainly in V.
Eigen::Vector3d pointOf(const TrianglePair& pair, fcl_prob_test::RandomBodies& random) {
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (const auto* corners : {&pair.a, &pair.b}) {
    Eigen::Vector3d weights(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    weights /= weights.sum();
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i)
      point += weights[i] * Eigen::Map<const Eigen::Vector3d>(corners->data() + 3 * i);
    result += corners == &pair.b ? point : Eigen::Vector3d(-point);
  }
  return result;
}

CellBox cellAround(const Eigen::Vector3d& centre, double half) {
  return {{centre[0], centre[1], centre[2]}, {half, 0.7 * half, 0.4 * half}};
}

Eigen::Vector3d pointIn(const CellBox& cell, fcl_prob_test::RandomBodies& random) {
  Eigen::Vector3d p;
  for (int k = 0; k < 3; ++k) p[k] = cell.center[k] + cell.half[k] * random.uniform(-1, 1);
  return p;
}

bool within(const TrianglePair& pair, const Eigen::Vector3d& y) {
  const CellBox point{{y[0], y[1], y[2]}, {0, 0, 0}};
  return slabKernels().classify(pair.slabs(), point).relation == CellRelation::inside;
}

bool excluded(const TrianglePair& pair, const Eigen::Vector3d& y) {
  const CellBox point{{y[0], y[1], y[2]}, {0, 0, 0}};
  return slabKernels().classify(pair.slabs(), point).relation == CellRelation::outside;
}

}  // namespace

TEST_CASE("points of the C-obstacle of two triangles are never outside its slabs", "[slabs]") {
  fcl_prob_test::RandomBodies random(5);
  for (int i = 0; i < 2000; ++i) {
    const TrianglePair pair = randomPair(random, random.logUniform(1e-3, 10.0));
    for (int j = 0; j < 20; ++j) CHECK_FALSE(excluded(pair, pointOf(pair, random)));
  }
}

TEST_CASE("a cell is classified as its points are", "[slabs]") {
  fcl_prob_test::RandomBodies random(6);
  std::array<int, 3> seen{};
  int slices = 0;
  for (int i = 0; i < 4000; ++i) {
    const TrianglePair pair = randomPair(random, 2.0);
    const CellBox cell = cellAround(pointOf(pair, random) + 0.5 * random.normalVector(),
                                    random.logUniform(0.02, 2.0));
    const CellCut cut = slabKernels().classify(pair.slabs(), cell);
    ++seen[static_cast<std::size_t>(cut.relation)];
    const CellSlice slice = slabKernels().coveredSlice(pair.slabs(), cell);
    double lo[3], hi[3];
    for (int k = 0; k < 3; ++k) {
      lo[k] = cell.center[k] - cell.half[k];
      hi[k] = cell.center[k] + cell.half[k];
    }
    slabKernels().contract(pair.slabs(), cell, lo, hi);
    const Eigen::Vector3d m = random.direction();
    const double lowest = slabKernels().minimumAlong(pair.slabs(), cell, m.data());
    for (int j = 0; j < 20; ++j) {
      const Eigen::Vector3d y = pointIn(cell, random);
      if (cut.relation == CellRelation::outside) CHECK(excluded(pair, y));
      if (cut.relation == CellRelation::inside) CHECK(within(pair, y));
      if (within(pair, y)) {
        CHECK(m.dot(y) >= lowest);
        for (int k = 0; k < 3; ++k) CHECK((y[k] >= lo[k] && y[k] <= hi[k]));
      }
      if (slice.axis < 0) continue;
      Eigen::Vector3d inner = y;
      const double end =
          cell.center[slice.axis] + (slice.at_lower_end ? -1 : 1) * cell.half[slice.axis];
      inner[slice.axis] = end + (slice.at_lower_end ? 1 : -1) * random.uniform(0, 1) * slice.width;
      CHECK(within(pair, inner));
      ++slices;
    }
  }
  CHECK(seen[0] > 200);
  CHECK(seen[1] > 200);
  CHECK(seen[2] > 200);
  CHECK(slices > 2000);
}

TEST_CASE("the kernels for this processor give the bits of those for every processor", "[slabs]") {
  const fcl_prob::detail::SlabKernels portable = fcl_prob::detail::portableSlabKernels();
  const fcl_prob::detail::SlabKernels& fastest = slabKernels();
  fcl_prob_test::RandomBodies random(9);
  for (int i = 0; i < 5000; ++i) {
    const TrianglePair pair = randomPair(random, random.logUniform(1e-3, 10.0));
    TrianglePair same = pair;
    portable.triangleSlabs(same.a.data(), same.b.data(), kNoError, same.data.data());
    REQUIRE(same.data == pair.data);
    const CellBox cell = cellAround(pointOf(pair, random) + 0.5 * random.normalVector(),
                                    random.logUniform(0.02, 2.0));
    const CellCut cut = fastest.classify(pair.slabs(), cell);
    const CellCut portable_cut = portable.classify(pair.slabs(), cell);
    REQUIRE(cut.relation == portable_cut.relation);
    REQUIRE(cut.sides == portable_cut.sides);
    REQUIRE(cut.covered == portable_cut.covered);
    const double* point = cell.center;
    REQUIRE(fastest.classifyPoint(pair.slabs(), point) ==
            portable.classifyPoint(pair.slabs(), point));
    const CellSlice slice = fastest.coveredSlice(pair.slabs(), cell);
    const CellSlice portable_slice = portable.coveredSlice(pair.slabs(), cell);
    REQUIRE(slice.axis == portable_slice.axis);
    REQUIRE(slice.width == portable_slice.width);
    const Eigen::Vector3d m = random.direction();
    REQUIRE(fastest.minimumAlong(pair.slabs(), cell, m.data()) ==
            portable.minimumAlong(pair.slabs(), cell, m.data()));
    std::array<double, 3> lo, hi;
    for (int k = 0; k < 3; ++k) {
      lo[k] = cell.center[k] - cell.half[k];
      hi[k] = cell.center[k] + cell.half[k];
    }
    std::array<double, 3> portable_lo = lo, portable_hi = hi;
    fastest.contract(pair.slabs(), cell, lo.data(), hi.data());
    portable.contract(pair.slabs(), cell, portable_lo.data(), portable_hi.data());
    REQUIRE(lo == portable_lo);
    REQUIRE(hi == portable_hi);
  }
}

TEST_CASE("a point is classified like a cell without extent", "[slabs]") {
  fcl_prob_test::RandomBodies random(11);
  std::array<int, 3> seen{};
  for (int i = 0; i < 20000; ++i) {
    const TrianglePair pair = randomPair(random, random.logUniform(1e-3, 10.0));
    const Eigen::Vector3d y =
        pointOf(pair, random) + random.uniform(0, 0.5) * random.normalVector();
    const CellRelation relation = slabKernels().classifyPoint(pair.slabs(), y.data());
    REQUIRE(relation == slabKernels().classify(pair.slabs(), cellAround(y, 0.0)).relation);
    ++seen[static_cast<std::size_t>(relation)];
  }
  CHECK(seen[static_cast<std::size_t>(CellRelation::inside)] > 1000);
  CHECK(seen[static_cast<std::size_t>(CellRelation::outside)] > 1000);
}

TEST_CASE("points in a box are those between its ends, each told once and in order", "[slabs]") {
  fcl_prob_test::RandomBodies random(12);
  const double nothing = std::nan("");
  for (int round = 0; round < 500; ++round) {
    const int count = 4 * random.integer(0, 8);
    std::array<std::vector<double>, 3> y;
    for (int k = 0; k < 3; ++k) {
      // On a grid, so that many points are on the faces of the box.
      for (int i = 0; i < count; ++i) y[k].push_back(random.integer(-3, 3));
    }
    if (count > 0) y[random.integer(0, 2)].back() = nothing;
    const double lo[3] = {-2, -1, -3};
    const double hi[3] = {2, 3, 1};
    std::vector<int> expected;
    for (int i = 0; i < count; ++i) {
      bool inside = true;
      for (int k = 0; k < 3; ++k) inside = inside && y[k][i] >= lo[k] && y[k][i] <= hi[k];
      if (inside) expected.push_back(i);
    }
    const PointArrays points{{y[0].data(), y[1].data(), y[2].data()}, count};
    for (const auto& kernels : {slabKernels(), fcl_prob::detail::portableSlabKernels()}) {
      std::vector<int> found(static_cast<std::size_t>(count));
      found.resize(static_cast<std::size_t>(kernels.pointsInBox(points, lo, hi, found.data())));
      CHECK(found == expected);
    }
  }
}

// Whitening stretches the axes along which little moves. Doubling is exact, so that the same points
// must be found within and outside, but for those that rounding leaves open.
TEST_CASE("stretched axes do not change what is known of a pair", "[slabs]") {
  fcl_prob_test::RandomBodies random(10);
  int inside = 0, outside = 0, open = 0;
  for (int i = 0; i < 2000; ++i) {
    const TrianglePair pair = randomPair(random, random.logUniform(0.1, 10.0));
    TrianglePair stretched = pair;
    Eigen::Vector3d stretch;
    for (int k = 0; k < 3; ++k) stretch[k] = std::ldexp(1.0, random.integer(0, 1) * 40);
    for (std::size_t k = 0; k < 9; ++k) {
      stretched.a[k] *= stretch[static_cast<int>(k % 3)];
      stretched.b[k] *= stretch[static_cast<int>(k % 3)];
    }
    slabKernels().triangleSlabs(stretched.a.data(), stretched.b.data(), kNoError,
                                stretched.data.data());
    for (int j = 0; j < 10; ++j) {
      const Eigen::Vector3d y = 3.0 * random.normalVector();
      const Eigen::Vector3d unstretched = y.cwiseQuotient(stretch);
      const bool is_open = !within(stretched, y) && !excluded(stretched, y);
      open += is_open;
      if (is_open) continue;
      CHECK(within(stretched, y) == within(pair, unstretched));
      CHECK(excluded(stretched, y) == excluded(pair, unstretched));
      ++(within(pair, unstretched) ? inside : outside);
    }
  }
  CHECK(inside > 1500);
  CHECK(outside > 1500);
  CHECK(open < 20);
}

TEST_CASE("pairs without volume contain nothing and exclude nothing of themselves", "[slabs]") {
  fcl_prob_test::RandomBodies random(8);
  for (int i = 0; i < 500; ++i) {
    TrianglePair pair = randomPair(random, 1.0);
    // A needle, a point, or a triangle in the plane of the other one.
    const int kind = i % 4;
    for (std::size_t k = 0; k < 3; ++k) {
      if (kind == 0) pair.a[6 + k] = 0.5 * (pair.a[k] + pair.a[3 + k]);
      if (kind == 1) pair.a[6 + k] = pair.a[3 + k] = pair.a[k];
      if (kind == 2) pair.a[3 * k + 2] = pair.b[3 * k + 2] = 0.25;
      if (kind == 3) {
        pair.a[6 + k] = pair.a[3 + k] = pair.a[k];
        pair.b[6 + k] = pair.b[3 + k] = pair.b[k];
      }
    }
    slabKernels().triangleSlabs(pair.a.data(), pair.b.data(), kNoError, pair.data.data());
    for (int j = 0; j < 10; ++j) {
      const Eigen::Vector3d y = pointOf(pair, random);
      CHECK_FALSE(excluded(pair, y));
      if (kind == 1 || kind == 2 || kind == 3) CHECK_FALSE(within(pair, y));
      const CellCut cut = slabKernels().classify(pair.slabs(), cellAround(y, 0.1));
      if (kind != 0) CHECK(cut.relation == CellRelation::cut);
    }
  }
}

TEST_CASE("what two needles cannot reach in their plane is excluded", "[slabs]") {
  fcl_prob_test::RandomBodies random(12);
  for (int i = 0; i < 500; ++i) {
    TrianglePair pair = randomPair(random, 1.0);
    const bool parallel = i % 2 == 0;
    for (std::size_t k = 0; k < 3; ++k) {
      pair.a[6 + k] = pair.a[3 + k];
      if (parallel) pair.b[3 + k] = pair.b[k] + 0.5 * (pair.a[3 + k] - pair.a[k]);
      pair.b[6 + k] = pair.b[k];
    }
    slabKernels().triangleSlabs(pair.a.data(), pair.b.data(), kNoError, pair.data.data());
    const auto corner = [](const std::array<double, 9>& vertices, int index) {
      return Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(vertices.data() + 3 * index));
    };
    const Eigen::Vector3d p = corner(pair.a, 1) - corner(pair.a, 0);
    const Eigen::Vector3d q = corner(pair.b, 1) - corner(pair.b, 0);
    const Eigen::Vector3d middle =
        0.5 * (corner(pair.b, 0) + corner(pair.b, 1) - corner(pair.a, 0) - corner(pair.a, 1));
    CHECK_FALSE(excluded(pair, middle));
    CHECK_FALSE(excluded(pair, middle + 0.499 * (p + q)));
    const Eigen::Vector3d sideways = parallel ? p.unitOrthogonal() : p;
    for (const double sign : {-1.0, 1.0}) {
      CHECK(excluded(pair, middle + sign * 0.501 * sideways + 0.3 * q));
      if (!parallel) CHECK(excluded(pair, middle + sign * 0.501 * q - 0.3 * p));
    }
  }
}
