// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Gradients of exact masses, which come from integrals over the boundary.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>

#include <cmath>

#include "catch.h"
#include "fcl_prob/fcl_prob.h"

namespace {

using namespace fcl_prob;
using Eigen::Vector3d;

struct GradientPair {
  std::shared_ptr<const fcl::CollisionGeometryd> a, b;
};

std::shared_ptr<const fcl::CollisionGeometryd> octahedron(double size) {
  const std::vector<Vector3d> corners = {{size, 0, 0},  {-0.7 * size, 0, 0}, {0, size, 0},
                                         {0, -size, 0}, {0, 0, 0.5 * size},  {0, 0, -size}};
  return convexGeometry(convexHull(corners));
}

std::vector<GradientPair> pairsOfSize(double size) {
  const auto box = std::make_shared<fcl::Boxd>(size, 0.8 * size, 0.6 * size);
  const auto cylinder = std::make_shared<fcl::Cylinderd>(0.4 * size, size);
  const auto cone = std::make_shared<fcl::Coned>(0.5 * size, size);
  const auto ellipsoid = std::make_shared<fcl::Ellipsoidd>(0.5 * size, 0.4 * size, 0.6 * size);
  const auto capsule = std::make_shared<fcl::Capsuled>(0.3 * size, 0.8 * size);
  const auto sphere = std::make_shared<fcl::Sphered>(0.4 * size);
  const auto hull = octahedron(0.6 * size);
  return {{box, box},           {box, hull},     {hull, hull},         {ellipsoid, box},
          {hull, ellipsoid},    {cylinder, box}, {cone, hull},         {ellipsoid, ellipsoid},
          {ellipsoid, capsule}, {cone, sphere},  {cylinder, cylinder}, {cylinder, cone}};
}

const fcl::Transform3d& turnedPose() {
  static const fcl::Transform3d pose(Eigen::Quaterniond(1, 0.2, 0.7, 0.1).normalized());
  return pose;
}

/// A pair whose C-obstacle has its middle at some place, in deviations of about 1.
ProbabilityResult exactAt(const GradientPair& pair, const Vector3d& place, const Vector3d& mean,
                          bool with_gradient) {
  fcl::Transform3d pose_b(Eigen::Quaterniond(1, -0.3, 0.1, 0.4).normalized());
  pose_b.translation() = place;
  const auto axes = Eigen::Quaterniond(1, 0.3, 0.2, 0.5).normalized();
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.7, 1, 1.2}, axes, mean);
  ProbabilityRequest request;
  request.method = ProbabilityMethod::exact;
  request.relative_tolerance = 1e-6;
  request.absolute_tolerance = 0;
  request.gradient = with_gradient;
  ProbabilityResult result;
  PreparedQuery(pair.a, pair.b)
      .collisionProbability(turnedPose(), pose_b, displacement, request, result);
  return result;
}

/// By central differences of the fourth order; certified is what the ends of answers tell.
double slopeAt(const GradientPair& pair, const Vector3d& place, int axis) {
  constexpr double kStep = 4e-3;
  const auto moved = [&](double steps) {
    return exactAt(pair, place, steps * kStep * Vector3d::Unit(axis), false).probability();
  };
  return (8 * (moved(1) - moved(-1)) - (moved(2) - moved(-2))) / (12 * kStep);
}

void checkGradient(const GradientPair& pair, const Vector3d& place) {
  const ProbabilityResult result = exactAt(pair, place, Vector3d::Zero(), true);
  CHECK(result.method == ProbabilityMethod::exact);
  REQUIRE(result.gradient);
  const double width = (*result.gradient_upper - *result.gradient_lower).norm();
  // What is left open of the mass weighs more where the mean is deep inside.
  CHECK(width <= 2e-5 * result.gradient->norm() + 1e-7 * *result.upper);
  for (int axis = 0; axis < 3; ++axis) {
    const double slope = slopeAt(pair, place, axis);
    // Rounding of differences and the fourth order of the step.
    const double error = 3e-5 * result.gradient->norm() + 1e-7 * *result.upper;
    CAPTURE(slope, (*result.gradient)[axis], *result.upper);
    CHECK(slope >= (*result.gradient_lower)[axis] - error);
    CHECK(slope <= (*result.gradient_upper)[axis] + error);
  }
}

}  // namespace

TEST_CASE("exact gradients are the slopes of exact masses", "[gradient]") {
  for (const double size : {0.3, 2.0, 20.0}) {
    int number = 0;
    for (const GradientPair& pair : pairsOfSize(size)) {
      CAPTURE(size, number++);
      // Near a corner, and some deviations outside.
      const Vector3d way = Vector3d(0.7, 0.5, -0.4).normalized();
      checkGradient(pair, 0.6 * size * way);
      checkGradient(pair, (1.1 * size + 3.0) * way);
    }
  }
}

TEST_CASE("the gradient of two boxes far out is that of the tail", "[gradient]") {
  // Faces of 10 deviations: P = Φ(-h) and no more.
  for (const double height : {5.0, 20.0, 36.0}) {
    const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
    fcl::Transform3d pose_b = fcl::Transform3d::Identity();
    pose_b.translation() = Vector3d(4 + 0.1 * height, 0, 0);
    ProbabilityRequest request;
    request.gradient = true;
    const fcl::Boxd box(4, 4, 4);
    ProbabilityResult result;
    collisionProbability(&box, fcl::Transform3d::Identity(), &box, pose_b, displacement, request,
                         result);
    CHECK(result.method == ProbabilityMethod::exact);
    REQUIRE(result.gradient);
    // Doubles of 4 and 0.1 tell the height to some ε.
    const double slope = std::exp(-0.5 * height * height) / std::sqrt(2 * M_PI) / 0.1;
    CHECK((*result.gradient)[0] == Approx(slope).epsilon(1e-11));
    CHECK(std::abs((*result.gradient)[1]) <= 1e-10 * slope);
    CHECK((*result.gradient_upper - *result.gradient_lower).norm() <= 4e-8 * slope);
  }
}
