// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Pairs of round shapes that move along fewer than three axes: what the automatic method makes of
// them.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>

#include <string>

#include "catch.h"
#include "exact_cases.h"
#include "fcl_prob/fcl_prob.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

TEST_CASE("swept polytopes that move along two axes are integrated over their section's boundary") {
  const fcl::Sphered sphere(0.3);
  const fcl::Ellipsoidd ellipsoid(0.3, 0.2, 0.4);
  const fcl::Boxd box(0.5, 0.4, 0.3);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.3, 0.1, 0.0});
  ProbabilityRequest request;
  request.relative_tolerance = 1e-8;
  for (const fcl::CollisionGeometryd* round :
       {static_cast<const fcl::CollisionGeometryd*>(&sphere),
        static_cast<const fcl::CollisionGeometryd*>(&ellipsoid)}) {
    const auto result = answer(*round, kIdentity, box, at({0.5, 0.2, 0.1}), displacement, request);
    CHECK(result.method == ProbabilityMethod::exact);
    CHECK(*result.upper - *result.lower <= 1e-9 * *result.upper);
    CHECK(planMentions(result, "section by quadrature"));
    ProbabilityRequest rough;
    rough.method = ProbabilityMethod::interval;
    const auto interval = answer(*round, kIdentity, box, at({0.5, 0.2, 0.1}), displacement, rough);
    CHECK(*interval.lower <= *result.upper);
    CHECK(*interval.upper >= *result.lower);
  }
}

TEST_CASE("rounded pairs that move along one axis only are left to the partition") {
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.3, 0.0, 0.0});
  const auto result = answer(fcl::Sphered(0.3), kIdentity, fcl::Boxd(0.5, 0.4, 0.3),
                             at({0.5, 0.2, 0.1}), displacement);
  CHECK(result.method == ProbabilityMethod::interval);
  CHECK(result.status == ProbabilityStatus::converged);
}

}  // namespace
