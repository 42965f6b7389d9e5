// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Pairs of round shapes that move along fewer than three axes: what the automatic method makes of
// them.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>

#include <vector>

#include "catch.h"
#include "exact_cases.h"
#include "fcl_prob/fcl_prob.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

TEST_CASE("swept polytopes that move along two axes have their section between two polygons") {
  const fcl::Sphered sphere(0.3);
  const fcl::Ellipsoidd ellipsoid(0.3, 0.2, 0.4);
  const fcl::Boxd box(0.5, 0.4, 0.3);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.3, 0.1, 0.0});
  ProbabilityRequest request;
  request.relative_tolerance = 1e-6;
  for (const fcl::CollisionGeometryd* round :
       {static_cast<const fcl::CollisionGeometryd*>(&sphere),
        static_cast<const fcl::CollisionGeometryd*>(&ellipsoid)}) {
    const auto result = answer(*round, kIdentity, box, at({0.5, 0.2, 0.1}), displacement, request);
    CHECK(result.method == ProbabilityMethod::exact);
    CHECK(*result.upper - *result.lower <= 2.5e-7 * *result.upper);
    CHECK(planMentions(result, "section between two polygons"));
    ProbabilityRequest rough;
    rough.method = ProbabilityMethod::interval;
    const auto interval = answer(*round, kIdentity, box, at({0.5, 0.2, 0.1}), displacement, rough);
    CHECK(*interval.lower <= *result.upper);
    CHECK(*interval.upper >= *result.lower);
  }
}

TEST_CASE("convex shapes that move along one axis are cut by a line, whatever they are") {
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.3, 0.0, 0.0});
  const fcl::Sphered sphere(0.3);
  const fcl::Cylinderd cylinder(0.3, 0.4);
  const fcl::Coned cone(0.2, 0.5);
  const fcl::Ellipsoidd ellipsoid(0.3, 0.2, 0.4);
  const fcl::Boxd box(0.5, 0.4, 0.3);
  ProbabilityRequest request;
  request.relative_tolerance = 1e-9;
  request.absolute_tolerance = 0.0;
  const std::vector<const fcl::CollisionGeometryd*> shapes{&sphere, &cylinder, &cone, &ellipsoid,
                                                           &box};
  for (const auto* a : shapes) {
    for (const auto* b : shapes) {
      const auto result = answer(*a, kIdentity, *b, at({0.5, 0.2, 0.1}), displacement, request);
      CAPTURE(a->getNodeType(), b->getNodeType());
      CHECK(result.method == ProbabilityMethod::exact);
      CHECK(*result.upper - *result.lower <= 1e-9 * *result.upper);
      ProbabilityRequest rough;
      rough.method = ProbabilityMethod::interval;
      const auto interval = answer(*a, kIdentity, *b, at({0.5, 0.2, 0.1}), displacement, rough);
      CHECK(*interval.lower <= *result.upper);
      CHECK(*interval.upper >= *result.lower);
    }
  }
}

TEST_CASE("curved shapes that move in a plane are exact to six digits") {
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.3, 0.1, 0.0});
  const fcl::Cylinderd cylinder(0.3, 0.4);
  const fcl::Coned cone(0.2, 0.5);
  const fcl::Ellipsoidd ellipsoid(0.3, 0.2, 0.4);
  ProbabilityRequest request;
  request.relative_tolerance = 1e-6;
  request.absolute_tolerance = 0.0;
  for (const fcl::CollisionGeometryd* a :
       {static_cast<const fcl::CollisionGeometryd*>(&cylinder),
        static_cast<const fcl::CollisionGeometryd*>(&ellipsoid)}) {
    const auto result = answer(*a, kIdentity, cone, at({0.5, 0.2, 0.1}), displacement, request);
    CHECK(result.method == ProbabilityMethod::exact);
    CHECK(result.status == ProbabilityStatus::converged);
    CHECK(planMentions(result, "between two polygons"));
    const auto swapped =
        answer(cone, at({0.5, 0.2, 0.1}), *a, kIdentity, displacement.reversed(), request);
    CHECK(*swapped.lower <= *result.upper);
    CHECK(*swapped.upper >= *result.lower);
  }
}

}  // namespace
