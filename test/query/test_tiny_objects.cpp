// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Objects by whose squares nothing can be compared are refused, not answered wrongly.
#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision_object.h>

#include "catch.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/normal_mass.h"
#include "mesh_shapes.h"
#include "random_bodies.h"
#include "shapes.h"

namespace {

using namespace fcl_prob;
using fcl_prob_test::RandomBodies;

/// Two cubes of half sides `size` and `size_b`, `gap` apart along x, where the first is displaced
/// by about its size, and hardly across.
struct TwoCubes {
  double size, size_b, gap;
  int rank;
  bool meshes = false;

  std::shared_ptr<fcl::CollisionGeometryd> cube(double half) const {
    const Eigen::Vector3d sides = Eigen::Vector3d::Constant(2 * half);
    if (meshes) return fcl_prob_test::makeModel<fcl::OBBRSSd>(fcl_prob_test::boxMesh(sides));
    return std::make_shared<fcl::Boxd>(sides);
  }

  Bounds ask(ProbabilityMethod method) const {
    fcl::Transform3d pose_a = fcl::Transform3d::Identity(), pose_b = pose_a;
    pose_a.translation().x() = size + gap;
    pose_b.translation().x() = -size_b;
    const fcl::CollisionObjectd a(cube(size), pose_a), b(cube(size_b), pose_b);
    const auto displacement = GaussianDisplacement::fromStandardDeviations(
        {size, rank > 1 ? 1e-3 * size : 0.0, rank > 2 ? 1e-3 * size : 0.0});
    ProbabilityRequest request;
    request.method = method;
    request.relative_tolerance = 0.05;
    request.max_cells = 200;  // what is 1e100 times smaller than the other is not resolved
    ProbabilityResult result;
    collisionProbability(&a, &b, displacement, request, result);
    return {result.lower.value_or(0.0), *result.upper};
  }

  double truth() const {
    return normalIntervalMass(gap / size, gap / size + 2 * (size_b / size) + 2);
  }
};

const std::vector<ProbabilityMethod> kMethods{
    ProbabilityMethod::automatic,   ProbabilityMethod::interval,
    ProbabilityMethod::exact,       ProbabilityMethod::convex_pcd,
    ProbabilityMethod::general_pcd, ProbabilityMethod::general_pcd_min};

TEST_CASE("boxes down to 1e-139 m have the probability of larger ones") {
  RandomBodies random(5);
  for (int i = 0; i < 60; ++i) {
    const double size = random.logUniform(1e-139, 1e-100);
    for (const double size_b : {size, 1.0}) {
      const TwoCubes cubes{size, size_b, size * random.uniform(-1.0, 2.0), 1 + i % 3};
      for (const ProbabilityMethod method : kMethods) {
        const Bounds bounds = cubes.ask(method);
        CAPTURE(size, size_b, cubes.rank, toString(method), bounds.lower, bounds.upper);
        CHECK(bounds.lower <= cubes.truth() * (1 + 1e-9));
        CHECK(bounds.upper >= cubes.truth() * (1 - 1e-9));
      }
    }
  }
}

TEST_CASE("smaller boxes are refused, unless the other one is larger") {
  RandomBodies random(6);
  for (int i = 0; i < 60; ++i) {
    const double size = random.logUniform(1e-200, 1e-141);
    const TwoCubes both{size, size, size * random.uniform(-1.0, 2.0), 1 + i % 3};
    const TwoCubes one{size, 1.0, size * random.uniform(-1.0, 2.0), 1 + i % 3};
    for (const ProbabilityMethod method : kMethods) {
      CAPTURE(size, both.rank, toString(method));
      CHECK_THROWS_AS(both.ask(method), InvalidGeometry);
      const Bounds bounds = one.ask(method);
      CHECK(bounds.lower <= one.truth() * (1 + 1e-9));
      CHECK(bounds.upper >= one.truth() * (1 - 1e-9));
    }
  }
}

TEST_CASE("meshes are refused as boxes are, whatever the method") {
  for (const double size : {1e-141, 1e-160, 1e-200}) {
    for (const int rank : {1, 2, 3}) {
      for (const ProbabilityMethod method : kMethods) {
        if (method == ProbabilityMethod::exact) continue;  // not of meshes
        CAPTURE(size, rank, toString(method));
        const TwoCubes cubes{size, size, 0.5 * size, rank, true};
        CHECK_THROWS_AS(cubes.ask(method), InvalidGeometry);
      }
    }
  }
}

}  // namespace
