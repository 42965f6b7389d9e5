// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Very many random pairs: nothing violated, no NaN, nothing that does not come back.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>

#include <chrono>
#include <cmath>
#include <iostream>

#include "catch.h"
#include "fcl_prob/convex_pcd.h"
#include "fcl_prob/fcl_prob.h"
#include "fcl_prob/monte_carlo.h"
#include "fcl_prob/normal_mass.h"
#include "mesh_shapes.h"
#include "random_bodies.h"
#include "shapes.h"

namespace {

using namespace fcl_prob;
using namespace fcl_prob_test;
using Eigen::Vector3d;
// Five standard errors of a normal distribution.
constexpr double kFiveSigma = 0.9999994;

struct Pair {
  Geometry a, b;
  fcl::Transform3d pose_a, pose_b;
  GaussianDisplacement displacement;
};

double stopwatch() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

// Any of FCL's convex shapes, of about `size`, its sides up to a factor of 100 apart. Most are
// flat: they are the ones with an exact answer, and quick.
Geometry randomShape(RandomBodies& random, double size) {
  const bool any = random.uniform(0, 1) < 0.05;
  const auto side = [&] { return size * random.logUniform(0.01, 1); };
  const double x = side(), y = side(), z = side();
  switch (random.integer(any ? 0 : 5, 7)) {
    case 0:
      return std::make_shared<fcl::Sphered>(x);
    case 1:
      return std::make_shared<fcl::Ellipsoidd>(x, y, z);
    case 2:
      return std::make_shared<fcl::Capsuled>(x, y);
    case 3:
      return std::make_shared<fcl::Cylinderd>(x, y);
    case 4:
      return std::make_shared<fcl::Coned>(x, y);
    case 5:
      return std::make_shared<fcl::TrianglePd>(x * random.direction(), y * random.direction(),
                                               z * random.direction());
    case 6:
      return randomConvex(random.integer(4, 12), x, static_cast<unsigned>(random.integer(1, 50)));
    default:
      return std::make_shared<fcl::Boxd>(x, y, z);
  }
}

// Deviations from 1e-3 to 1e3 sizes, some of them 0; near, touching or apart.
GaussianDisplacement anyDisplacement(RandomBodies& random, double size) {
  const auto deviation = [&] {
    return random.uniform(0, 1) < 0.05 ? 0.0 : size * random.logUniform(1e-3, 1e3);
  };
  const double x = deviation(), y = deviation(), z = deviation();
  return GaussianDisplacement::fromStandardDeviations({x, y, z}, random.quaternion());
}

Pair place(RandomBodies& random, Geometry a, Geometry b, double size) {
  const GaussianDisplacement displacement = anyDisplacement(random, size);
  Pair pair{std::move(a), std::move(b), random.pose(0.3 * size), random.pose(0.3 * size),
            displacement};
  const Vector3d along =
      displacement.axes() *
      (displacement.standardDeviations().cwiseProduct(random.uniform(0, 3) * random.direction()));
  pair.pose_b.translation() += along;
  return pair;
}

ProbabilityResult answer(const Pair& pair, const ProbabilityRequest& request) {
  ProbabilityResult result;
  collisionProbability(pair.a.get(), pair.pose_a, pair.b.get(), pair.pose_b, pair.displacement,
                       request, result);
  return result;
}

void requireSound(const ProbabilityResult& result) {
  REQUIRE(result.lower);
  REQUIRE(result.upper);
  REQUIRE(*result.lower >= 0.0);
  REQUIRE(*result.lower <= *result.upper);
  REQUIRE(*result.upper <= 1.0);
  REQUIRE(std::isfinite(result.probability()));
}

void requireSampled(const Pair& pair, const ProbabilityResult& certified,
                    ProbabilityRequest sampling) {
  sampling.method = ProbabilityMethod::monte_carlo;
  sampling.confidence = kFiveSigma;
  sampling.relative_tolerance = 1e-9;
  const Bounds sampled = answer(pair, sampling).confidence_interval.value();
  REQUIRE(*certified.lower <= sampled.upper);
  REQUIRE(*certified.upper >= sampled.lower);
}

// FCL's own test of curved pairs and triangles errs, or is not there.
bool canBeSampled(const Pair& pair) {
  const auto simple = [](const fcl::CollisionGeometryd& geometry) {
    return geometry.getNodeType() == fcl::GEOM_BOX || geometry.getNodeType() == fcl::GEOM_SPHERE;
  };
  return simple(*pair.a) && simple(*pair.b) && pair.displacement.rank() == 3;
}

struct Tally {
  int exact = 0, narrow = 0, sampled = 0, likely = 0, rare = 0;
  double slowest = 0;

  void add(const ProbabilityResult& result, double seconds) {
    exact += result.method == ProbabilityMethod::exact;
    narrow += *result.upper - *result.lower <= 0.05 * *result.upper;
    likely += *result.lower > 0.1;
    rare += *result.upper < 1e-6;
    slowest = std::max(slowest, seconds);
  }

  void print(const char* what, int count, double seconds) const {
    std::cout << count << " " << what << ": " << seconds / count * 1e6 << " us each, the slowest "
              << slowest * 1e3 << " ms; " << exact << " exact, " << narrow << " narrower than 5 %, "
              << sampled << " sampled, " << likely << " above 0.1, " << rare << " below 1e-6"
              << std::endl;
  }
};

void checkConvexPairs(int count, unsigned seed) {
  RandomBodies random(seed);
  Tally tally;
  ProbabilityRequest request;
  request.relative_tolerance = 0.05;
  request.absolute_tolerance = 1e-300;
  request.max_cells = 25;
  const double started = stopwatch();
  for (int i = 0; i < count; ++i) {
    const double size = random.logUniform(1e-3, 1e3);
    const Geometry a = randomShape(random, size), b = randomShape(random, size);
    const Pair pair = place(random, a, b, size);
    CAPTURE(i, static_cast<int>(a->getNodeType()), static_cast<int>(b->getNodeType()));
    const double begin = stopwatch();
    const ProbabilityResult result = answer(pair, request);
    requireSound(result);
    tally.add(result, stopwatch() - begin);
    // Polytopes around curved bodies take a hundred times as long as everything else.
    const bool flat = result.method == ProbabilityMethod::exact;
    if (pair.displacement.rank() > 0 && (flat || i % 20 == 0)) {
      const double bound =
          convexPcd(ConvexBody(*a), pair.pose_a, ConvexBody(*b), pair.pose_b, pair.displacement)
              .least;
      CAPTURE(*result.lower, *result.upper, bound);
      REQUIRE(*result.lower <= bound);
    }
    if (!canBeSampled(pair)) continue;
    ProbabilityRequest sampling;
    sampling.samples = 200;
    sampling.seed = static_cast<std::uint64_t>(i);
    requireSampled(pair, result, sampling);
    ++tally.sampled;
  }
  tally.print("convex pairs", count, stopwatch() - started);
  CHECK(tally.exact > count / 2);
  CHECK(tally.narrow > count / 2);
  CHECK(tally.likely > count / 50);
  CHECK(tally.rare > count / 10);
  CHECK(tally.sampled > count / 100);
}

// Boxes along the axes of the displacement, in any world: P is a product.
void checkAlignedBoxes(int count, unsigned seed) {
  RandomBodies random(seed);
  for (int i = 0; i < count; ++i) {
    const double size = random.logUniform(1e-3, 1e3);
    const auto sides = [&]() -> Vector3d {
      return size *
             Vector3d(random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1));
    };
    const Vector3d sides_a = sides(), sides_b = sides();
    const Vector3d sigma(random.logUniform(0.1, 10), random.logUniform(0.1, 10),
                         random.logUniform(0.1, 10));
    const Vector3d half = 0.5 * (sides_a + sides_b);
    const Vector3d move = half.cwiseProduct(random.direction()) +
                          random.uniform(0, 5) * sigma.cwiseProduct(random.direction());
    const Eigen::Quaterniond turn = random.quaternion();
    const Pair pair{std::make_shared<fcl::Boxd>(sides_a), std::make_shared<fcl::Boxd>(sides_b),
                    fcl::Transform3d(turn), turn * Eigen::Translation3d(move),
                    GaussianDisplacement::fromStandardDeviations(sigma, turn)};
    const double expected =
        normalBoxMass((move - half).cwiseQuotient(sigma), (move + half).cwiseQuotient(sigma));
    const ProbabilityResult result = answer(pair, {});
    requireSound(result);
    CAPTURE(i, expected, *result.lower, *result.upper);
    // The poses are rounded: to 1e-16 of the sizes, in units of the least deviation.
    const double rounding = 1e-10 + 1e-13 * half.maxCoeff() / sigma.minCoeff();
    REQUIRE(*result.lower <= expected * (1 + rounding) + 1e-300);
    REQUIRE(*result.upper >= expected * (1 - rounding));
  }
}

Geometry randomMesh(RandomBodies& random) {
  const int rings = random.integer(2, 6), segments = random.integer(3, 8);
  const double size = random.uniform(0.2, 1);
  switch (random.integer(0, 3)) {
    case 0:
      return makeModel<fcl::OBBRSSd>(sphereMesh(size, rings, segments));
    case 1:
      return makeModel<fcl::OBBRSSd>(torusMesh(size, 0.3 * size, segments, 3));
    case 2:
      return makeModel<fcl::OBBRSSd>(boxMesh(size * Vector3d(1, random.uniform(0.1, 1), 0.5)));
    default:
      return makeModel<fcl::OBBRSSd>(
          bumpyMesh(size, rings, segments, static_cast<std::uint64_t>(random.integer(1, 1000))));
  }
}

void checkMeshPairs(int count, unsigned seed, std::size_t cells, bool timed) {
  constexpr double kTimeLimit = 0.5;
  RandomBodies random(seed);
  Tally tally;
  int late = 0;
  const double started = stopwatch();
  for (int i = 0; i < count; ++i) {
    Pair pair{randomMesh(random), randomMesh(random), random.pose(0.2), random.pose(2.0),
              randomDisplacement(random, 0.01, 1.0)};
    ProbabilityRequest request;
    request.method = ProbabilityMethod::interval;
    request.contact = random.integer(0, 1) == 0 ? ContactMeaning::fcl : ContactMeaning::solid;
    request.relative_tolerance = 0.02;
    request.absolute_tolerance = 1e-6;
    request.max_cells = cells;
    if (timed) request.time_limit = kTimeLimit;
    CAPTURE(i);
    const double begin = stopwatch();
    const ProbabilityResult result = answer(pair, request);
    const double seconds = stopwatch() - begin;
    late += seconds > 1.2 * kTimeLimit;
    requireSound(result);
    tally.add(result, seconds);
    CAPTURE(*result.lower, *result.upper);
    ProbabilityRequest sampling;
    sampling.contact = request.contact;
    sampling.samples = 500;
    sampling.seed = static_cast<std::uint64_t>(i);
    requireSampled(pair, result, sampling);
    ++tally.sampled;
  }
  tally.print("mesh pairs", count, stopwatch() - started);
  CHECK(tally.narrow > count / 3);
  CHECK(tally.likely > count / 10);
  if (timed) CHECK(late == 0);
}

}  // namespace

TEST_CASE("a thousand random convex pairs: nothing violated", "[random]") {
  checkConvexPairs(1'000, 1);
}

TEST_CASE("a thousand random pairs of aligned boxes: nothing violated", "[random]") {
  checkAlignedBoxes(1'000, 2);
}

TEST_CASE("60 random mesh pairs: nothing violated", "[random]") {
  checkMeshPairs(60, 3, 2'000, false);
}

TEST_CASE("900000 random convex pairs: nothing violated", "[random][long]") {
  for (unsigned seed = 10; seed < 100; ++seed) checkConvexPairs(10'000, seed);
}

TEST_CASE("100000 random pairs of aligned boxes: nothing violated", "[random][long]") {
  checkAlignedBoxes(100'000, 4);
}

TEST_CASE("10000 random mesh pairs: nothing violated and none late", "[random][long]") {
  for (unsigned seed = 100; seed < 110; ++seed) checkMeshPairs(1'000, seed, 200'000, true);
}
