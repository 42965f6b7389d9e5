// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The partition of pairs with curved shapes.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <cmath>

#include "catch.h"
#include "fcl_prob/collision_probability.h"
#include "mesh_shapes.h"
#include "poses.h"
#include "query/partition.h"
#include "random_bodies.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;
using fcl_prob::detail::buildPieceTree;
using fcl_prob::detail::partitionProbability;

namespace {

ProbabilityResult run(const fcl::CollisionGeometryd& a, const fcl::Transform3d& pose_a,
                      const fcl::CollisionGeometryd& b, const fcl::Transform3d& pose_b,
                      const GaussianDisplacement& displacement, const ProbabilityRequest& request) {
  const auto tree_a = buildPieceTree(a);
  const auto tree_b = buildPieceTree(b);
  return partitionProbability({tree_a.get(), {{pose_a, nullptr}}},
                              {tree_b.get(), {{pose_b, nullptr}}}, displacement, request);
}

ProbabilityRequest withTolerance(double relative) {
  ProbabilityRequest request;
  request.relative_tolerance = relative;
  request.absolute_tolerance = 0.0;
  return request;
}

double density(double x) { return std::exp(-0.5 * x * x) / std::sqrt(2 * M_PI); }
double below(double x) { return 0.5 * std::erfc(-x / std::sqrt(2)); }

// P(|y - c| <= r), y ~ N(0, I) in three dimensions, d = |c| > 0.
double ballMass(double d, double r) {
  return below(r - d) - below(-r - d) - (density(r - d) - density(r + d)) / d;
}

}  // namespace

TEST_CASE("two spheres under an isotropic covariance: the closed form", "[slow]") {
  RandomBodies random(1);
  const fcl::Sphered a(0.4), b(0.3);
  int rare = 0, likely = 0;
  for (const double sigma : {0.05, 0.3, 1.5}) {
    for (const double distance : {0.3, 0.8, 0.9}) {
      const Eigen::Vector3d position = distance * random.direction();
      const double expected = ballMass(distance / sigma, 0.7 / sigma);
      const auto displacement = GaussianDisplacement::fromStandardDeviations({sigma, sigma, sigma});
      const ProbabilityResult result =
          run(a, kIdentity, b, at(position), displacement, withTolerance(2e-3));
      INFO("sigma " << sigma << ", distance " << distance << ", P " << expected);
      CHECK(result.status == ProbabilityStatus::converged);
      CHECK(*result.lower <= expected * (1 + 1e-9));
      CHECK(*result.upper >= expected * (1 - 1e-9));
      CHECK(*result.upper - *result.lower <= 2e-3 * *result.upper);
      rare += expected < 0.01;
      likely += expected > 0.1;
    }
  }
  CHECK(rare >= 1);
  CHECK(likely >= 3);
}

TEST_CASE("spheres that move in one or two directions only") {
  const fcl::Sphered a(0.4), b(0.3);
  // Along x only: the displacements between -0.1 -+ sqrt(0.49 - 0.25) collide.
  const auto line = GaussianDisplacement::fromStandardDeviations({0.2, 0, 0});
  const double half = std::sqrt(0.49 - 0.25);
  const ProbabilityResult along =
      run(a, kIdentity, b, at({0.1, 0.3, 0.4}), line, withTolerance(1e-6));
  const double expected = below((0.1 + half) / 0.2) - below((0.1 - half) / 0.2);
  CHECK(*along.lower <= expected * (1 + 1e-12));
  CHECK(*along.upper >= expected * (1 - 1e-12));
  CHECK(*along.upper - *along.lower <= 1e-6 * *along.upper);
  // In the plane, concentric discs: Rayleigh's distribution.
  const auto plane = GaussianDisplacement::fromStandardDeviations({0.5, 0.5, 0});
  const ProbabilityResult within =
      run(a, kIdentity, b, at({0, 0, 0.3}), plane, withTolerance(1e-3));
  const double disc = 1 - std::exp(-0.5 * (0.49 - 0.09) / 0.25);
  CHECK(*within.lower <= disc);
  CHECK(*within.upper >= disc);
  CHECK(*within.upper - *within.lower <= 1e-3 * *within.upper);
  // Out of reach in the direction that does not move.
  CHECK(*run(a, kIdentity, b, at({0, 0, 0.71}), plane, withTolerance(1e-3)).upper < 1e-300);
}

TEST_CASE("estimate and gradient of curved pairs agree with the interval", "[slow]") {
  RandomBodies random(2);
  const auto shapes = boundedShapes();
  int compared = 0;
  for (std::size_t i = 1; i < 6; ++i) {
    for (std::size_t j = i % 2; j < 6; j += 2) {
      const auto displacement = randomDisplacement(random, 0.05, 0.2);
      fcl::Transform3d pose_b = at(0.8 * random.direction());
      pose_b.linear() = random.rotation();
      INFO(shapes[i].name << " and " << shapes[j].name);
      const auto query = [&](const ProbabilityRequest& request, const Eigen::Vector3d& mean) {
        return run(*shapes[i].geometry, kIdentity, *shapes[j].geometry, pose_b,
                   displacement.withMean(mean), request);
      };
      ProbabilityRequest request = withTolerance(3e-3);
      request.gradient = true;
      const ProbabilityResult interval = query(request, Eigen::Vector3d::Zero());
      if (*interval.upper < 1e-4) continue;
      ++compared;
      request.method = ProbabilityMethod::estimate;
      const ProbabilityResult estimate = query(request, Eigen::Vector3d::Zero());
      CHECK(*estimate.estimate >= *interval.lower - 5 * *estimate.standard_error);
      CHECK(*estimate.estimate <= *interval.upper + 5 * *estimate.standard_error);
      // P(mean + step) - P(mean - step) against the gradient, both with their bounds.
      const double sigma = displacement.standardDeviations().minCoeff();
      const double step = 0.3 * sigma;
      const int axis = compared % 3;
      const Eigen::Vector3d move = step * Eigen::Vector3d::Unit(axis);
      const ProbabilityResult ahead = query(withTolerance(3e-3), move);
      const ProbabilityResult behind = query(withTolerance(3e-3), -move);
      const double least = (*ahead.lower - *behind.upper) / (2 * step);
      const double most = (*ahead.upper - *behind.lower) / (2 * step);
      // The third derivative of P is below 1.4 / sigma^3.
      const double curvature = step * step / 6 * 1.4 / (sigma * sigma * sigma);
      CHECK((*interval.gradient_lower)[axis] <= most + curvature);
      CHECK((*interval.gradient_upper)[axis] >= least - curvature);
    }
  }
  CHECK(compared > 8);
}

TEST_CASE("curved shapes and meshes: the interval holds what displaced fcl::collide counts") {
  RandomBodies random(3);
  int between = 0;
  for (const NamedGeometry& mesh : meshes()) {
    for (const NamedGeometry& shape : boundedShapes()) {
      if (shape.name == "TriangleP") continue;  // fcl::collide does not know it
      const auto displacement = randomDisplacement(random, 0.03, 0.2);
      fcl::Transform3d pose = at(0.8 * random.direction());
      pose.linear() = random.rotation();
      const ProbabilityResult result =
          run(*mesh.geometry, kIdentity, *shape.geometry, pose, displacement, withTolerance(0.02));
      const Eigen::Matrix3d factor =
          displacement.axes() * displacement.standardDeviations().asDiagonal();
      const int samples = 1500;
      int hits = 0;
      for (int i = 0; i < samples; ++i) {
        const double x = random.normal(), y = random.normal(), z = random.normal();
        const fcl::CollisionRequestd request;
        fcl::CollisionResultd collision;
        fcl::collide(mesh.geometry.get(), at(factor * Eigen::Vector3d(x, y, z)),
                     shape.geometry.get(), pose, request, collision);
        hits += collision.isCollision();
      }
      const double frequency = static_cast<double>(hits) / samples;
      const double error = std::sqrt(frequency * (1 - frequency) / samples) + 0.5 / samples;
      INFO(mesh.name << " and " << shape.name << " frequency " << frequency << " interval "
                     << *result.lower << " " << *result.upper);
      CHECK(result.status == ProbabilityStatus::converged);
      CHECK(*result.lower <= frequency + 5 * error);
      CHECK(*result.upper >= frequency - 5 * error);
      between += frequency > 0.01 && frequency < 0.99;
    }
  }
  CHECK(between > 6);
}

TEST_CASE("round shapes beside the mesh of a thin box: the exact mass of the pair, in few cells") {
  // What is thicker than the box cannot be inside of it, so that its surface is all that counts.
  RandomBodies random(4);
  const Eigen::Vector3d sides(0.8, 0.5, 0.1);
  const auto mesh = makeModel<fcl::OBBRSSd>(boxMesh(sides));
  const fcl::Boxd box(sides);
  const fcl::Sphered sphere(0.2);
  const fcl::Capsuled capsule(0.15, 0.4);
  const fcl::Ellipsoidd ellipsoid(0.3, 0.2, 0.12);
  for (const fcl::CollisionGeometryd* shape :
       {static_cast<const fcl::CollisionGeometryd*>(&sphere),
        static_cast<const fcl::CollisionGeometryd*>(&capsule),
        static_cast<const fcl::CollisionGeometryd*>(&ellipsoid)}) {
    for (int i = 0; i < 3; ++i) {
      const auto displacement = randomDisplacement(random, 0.05, 0.2);
      fcl::Transform3d pose = at(0.5 * random.direction());
      pose.linear() = random.rotation();
      ProbabilityRequest request = withTolerance(2e-3);
      request.max_cells = 30'000;
      const ProbabilityResult result = run(*shape, kIdentity, *mesh, pose, displacement, request);
      request.method = ProbabilityMethod::exact;
      request.relative_tolerance = 1e-8;
      ProbabilityResult exact;
      collisionProbability(shape, kIdentity, &box, pose, displacement, request, exact);
      INFO("shape " << shape->getNodeType() << ", P " << *exact.lower << " " << *exact.upper
                    << ", interval " << *result.lower << " " << *result.upper << ", cells "
                    << result.statistics.cells);
      CHECK(result.status == ProbabilityStatus::converged);
      CHECK(*result.lower <= *exact.upper);
      CHECK(*result.upper >= *exact.lower);
    }
  }
}
