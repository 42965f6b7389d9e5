// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Pairs of which both sides are one piece: their trees have nothing to expand.
#include <fcl/geometry/shape/box.h>

#include "catch.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/normal_mass.h"
#include "fcl_prob/triangle_mesh.h"

using namespace fcl_prob;

TEST_CASE("the interval of two boxes holds the product of interval masses", "[query]") {
  const fcl::Boxd a(0.4, 0.3, 0.2);
  const fcl::Boxd b(0.4, 0.4, 0.25);
  const Eigen::Vector3d half = 0.5 * (a.side + b.side);
  ProbabilityRequest request;
  request.method = ProbabilityMethod::interval;
  for (const Eigen::Vector3d& sigma :
       {Eigen::Vector3d(0.08, 0.05, 0.06), Eigen::Vector3d(0.08, 0.05, 0.0)}) {
    fcl::Transform3d pose_a = fcl::Transform3d::Identity();
    pose_a.translation() = Eigen::Vector3d(0.5, 0.07, 0.03);
    double expected = 1.0;
    for (int k = 0; k < 3; ++k) {
      if (sigma[k] == 0.0) continue;
      const double middle = pose_a.translation()[k];
      expected *= normalIntervalMass((-half[k] - middle) / sigma[k], (half[k] - middle) / sigma[k]);
    }
    ProbabilityResult result;
    collisionProbability(&a, pose_a, &b, fcl::Transform3d::Identity(),
                         GaussianDisplacement::fromStandardDeviations(sigma), request, result);
    CHECK(result.lower.value() <= expected);
    CHECK(result.upper.value() >= expected);
    CHECK(result.upper.value() - result.lower.value() <= 0.011 * expected);
  }
}

TEST_CASE("the interval of two single triangles agrees with Monte Carlo", "[query]") {
  TriangleMesh triangle;
  triangle.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.2}};
  triangle.triangles = {{0, 1, 2}};
  const auto mesh = buildModel<fcl::OBBRSSd>(triangle);
  fcl::Transform3d pose_a = fcl::Transform3d::Identity();
  pose_a.linear() = Eigen::AngleAxisd(1.2, Eigen::Vector3d(1, 2, 0.5).normalized()).matrix();
  pose_a.translation() = Eigen::Vector3d(0.2, -0.1, 0.3);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.3, 0.2, 0.1});
  const auto answer = [&](ProbabilityMethod method) {
    ProbabilityRequest request;
    request.method = method;
    request.absolute_tolerance = 0.0;
    request.relative_tolerance = method == ProbabilityMethod::monte_carlo ? 1e-12 : 0.01;
    request.samples = 50'000;
    ProbabilityResult result;
    collisionProbability(mesh.get(), pose_a, mesh.get(), fcl::Transform3d::Identity(), displacement,
                         request, result);
    return result;
  };
  const ProbabilityResult interval = answer(ProbabilityMethod::interval);
  const ProbabilityResult sampled = answer(ProbabilityMethod::monte_carlo);
  const double error = 5.0 * sampled.standard_error.value();
  CHECK(sampled.estimate.value() > 0.05);
  CHECK(interval.lower.value() <= sampled.estimate.value() + error);
  CHECK(interval.upper.value() >= sampled.estimate.value() - error);
}
