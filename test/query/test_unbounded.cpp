// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Half-spaces, planes and octrees against closed forms.
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>

#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "catch.h"
#include "exact_cases.h"
#include "fcl_prob/fcl_prob.h"
#include "fcl_prob/normal_mass.h"
#include "mesh_shapes.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

void checkHolds(const ProbabilityResult& result, double expected) {
  CAPTURE(*result.lower, *result.upper, expected);
  CHECK(*result.lower <= expected * (1 + 1e-14));
  CHECK(*result.upper >= expected * (1 - 1e-14));
  CHECK(*result.upper - *result.lower <= 1e-11 * expected);
}

const auto kDisplacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.3});

}  // namespace

TEST_CASE("a ball over a half-space: one normal tail, in both orders, far into the tail") {
  const fcl::Halfspaced floor(Eigen::Vector3d::UnitZ(), 0.5);
  const fcl::Sphered ball(0.2);
  for (const double sigmas : {-30.0, -3.0, 0.5, 2.0, 10.0, 30.0}) {
    const fcl::Transform3d pose = at(5.0, -7.0, 0.7 + 0.3 * sigmas);
    const double expected = normalTailMass(sigmas);
    const auto above = answer(ball, pose, floor, kIdentity, kDisplacement);
    const auto below = answer(floor, kIdentity, ball, pose, kDisplacement);
    CHECK(above.method == ProbabilityMethod::exact);
    CAPTURE(sigmas);
    CHECK(above.probability() == Approx(expected).epsilon(1e-11));
    CHECK(*above.lower <= expected * (1 + 1e-13 * (1 + sigmas * sigmas)));
    CHECK(*above.upper >= expected * (1 - 1e-13 * (1 + sigmas * sigmas)));
    CHECK(below.probability() == Approx(expected).epsilon(1e-11));
  }
}

TEST_CASE("a half-space that is met with less than the least normal number") {
  using Wide = boost::multiprecision::cpp_bin_float_50;
  const fcl::Halfspaced floor(Eigen::Vector3d::UnitZ(), 0.0);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({1.0, 1.0, 1.0});
  int denormal = 0;
  for (int step = 0; step < 400; ++step) {
    const double gap = 37.0 + step / 256.0;
    const Wide truth = boost::math::erfc(Wide(gap) / sqrt(Wide(2))) / 2;
    const auto result =
        answer(fcl::Sphered(0.5), at(0, 0, gap + 0.5), floor, kIdentity, displacement);
    CAPTURE(gap, *result.lower, *result.upper);
    CHECK(Wide(*result.lower) <= truth);
    CHECK(Wide(*result.upper) >= truth);
    denormal += truth > 0 && truth < 1e-308;
  }
  CHECK(denormal > 50);
}

TEST_CASE("a plane is a surface: the ball may be on either side") {
  const fcl::Planed plane(Eigen::Vector3d::UnitX(), 0.0);
  const fcl::Sphered ball(0.2);
  const auto result = answer(ball, at(0.5, 0, 0), plane, kIdentity, kDisplacement);
  checkHolds(result, normalIntervalMass(-7.0, -3.0));
}

TEST_CASE("a plane between two parts of a mesh touches neither") {
  const TriangleMesh left = transformed(boxMesh({0.2, 0.2, 0.2}), at(-1, 0, 0));
  const TriangleMesh right = transformed(boxMesh({0.2, 0.2, 0.2}), at(1, 0, 0));
  const auto parts = makeModel<fcl::KDOPd<18>>(joined(left, right));
  const fcl::Planed plane(Eigen::Vector3d::UnitX(), 0.0);
  const auto wide = GaussianDisplacement::fromStandardDeviations({1.0, 0.5, 0.1});
  checkHolds(answer(*parts, kIdentity, plane, kIdentity, wide), 2 * normalIntervalMass(0.9, 1.1));
}

TEST_CASE("the gradient across a half-space is the normal density") {
  const fcl::Halfspaced floor(Eigen::Vector3d::UnitZ(), 0.0);
  ProbabilityRequest request;
  request.gradient = true;
  const auto result =
      answer(fcl::Sphered(0.2), at(0, 0, 0.8), floor, kIdentity, kDisplacement, request);
  const double slope = -0.39894228040143268 * std::exp(-2.0) / 0.3;
  REQUIRE(result.gradient);
  CHECK((*result.gradient)[0] == Approx(0.0).margin(1e-12));
  CHECK((*result.gradient)[2] == Approx(slope).epsilon(1e-12));
  CHECK((*result.gradient_lower)[2] <= slope * (1 - 1e-14));
  CHECK((*result.gradient_upper)[2] >= slope * (1 + 1e-14));
}

TEST_CASE("two unbounded shapes meet for certain unless they are parallel") {
  const fcl::Halfspaced up(Eigen::Vector3d::UnitZ(), 0.0);     // z <= 0
  const fcl::Halfspaced down(-Eigen::Vector3d::UnitZ(), 0.0);  // z >= 0
  const fcl::Halfspaced aside(Eigen::Vector3d::UnitX(), 0.0);
  const fcl::Planed level(Eigen::Vector3d::UnitZ(), 0.0);
  const fcl::Planed wall(Eigen::Vector3d::UnitY(), 0.0);
  const auto p = [](const fcl::CollisionGeometryd& a, const fcl::CollisionGeometryd& b,
                    double height) {
    return answer(a, at(0, 0, height), b, kIdentity, kDisplacement);
  };
  for (const fcl::CollisionGeometryd* other :
       {static_cast<const fcl::CollisionGeometryd*>(&aside),
        static_cast<const fcl::CollisionGeometryd*>(&wall)}) {
    CHECK(*p(up, *other, 9.0).lower == Approx(1.0).epsilon(1e-12));
    CHECK(*p(*other, level, 9.0).lower == Approx(1.0).epsilon(1e-12));
  }
  CHECK(*p(up, up, -3.0).lower == Approx(1.0).epsilon(1e-12));
  checkHolds(p(down, up, 0.6), normalTailMass(2.0));
  checkHolds(p(up, down, -0.6), normalTailMass(2.0));
  checkHolds(p(level, up, 0.3), normalTailMass(1.0));
  checkHolds(p(up, level, -0.3), normalTailMass(1.0));
  CHECK(*p(level, level, 0.1).upper < 1e-12);
}

TEST_CASE("without motion along the normal a half-space is touched or not") {
  const fcl::Halfspaced floor(Eigen::Vector3d::UnitZ(), 0.0);
  const auto level = GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.0});
  const fcl::Boxd box(1, 1, 1);
  CHECK(*answer(box, at(0, 0, 0.6), floor, kIdentity, level).upper < 1e-300);
  CHECK(*answer(box, at(0, 0, 0.4), floor, kIdentity, level).lower == Approx(1.0).epsilon(1e-12));
  CHECK(*answer(box, at(0, 0, 0.4), floor, kIdentity, {}).lower == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("an octree is the union of its occupied cells") {
  // Two cells side by side: one box of 0.2 m along x.
  const auto cells = std::make_shared<octomap::OcTree>(0.1);
  cells->updateNode(0.05, 0.05, 0.05, true);
  cells->updateNode(0.15, 0.05, 0.05, true);
  cells->updateNode(0.25, 0.05, 0.05, false);
  const fcl::OcTreed octree{std::shared_ptr<const octomap::OcTree>(cells)};
  const fcl::Boxd box(0.1, 0.1, 0.1);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  ProbabilityRequest request;
  request.relative_tolerance = 1e-4;
  const auto result = answer(box, at(0.45, 0.05, 0.05), octree, kIdentity, displacement, request);
  const double across = normalIntervalMass(-1.0, 1.0);
  const double expected = normalIntervalMass(2.0, 5.0) * across * across;
  CHECK(*result.lower <= expected * (1 + 1e-12));
  CHECK(*result.upper >= expected * (1 - 1e-12));
  CHECK(*result.upper - *result.lower <= 1.1e-4 * expected);

  const fcl::OcTreed nothing{std::make_shared<const octomap::OcTree>(0.1)};
  CHECK_THROWS_AS(answer(box, kIdentity, nothing, kIdentity, displacement), InvalidGeometry);
}
