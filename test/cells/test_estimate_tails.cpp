// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Estimates from few cells and few samples: their standard errors say so, and are as asked for.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "catch.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/normal_mass.h"
#include "mesh_shapes.h"
#include "random_bodies.h"

using namespace fcl_prob;
using fcl_prob_test::RandomBodies;

namespace {

std::shared_ptr<fcl::CollisionGeometryd> randomBox(RandomBodies& random) {
  const auto side = [&random] { return random.logUniform(0.05, 2); };
  return std::make_shared<fcl::Boxd>(side(), side(), side());
}

std::shared_ptr<fcl::CollisionGeometryd> randomTriangle(RandomBodies& random) {
  const auto corner = [&random] { return Eigen::Vector3d(0.3 * random.normalVector()); };
  return std::make_shared<fcl::TrianglePd>(corner(), corner(), corner());
}

/// A box as a mesh of so many triangles that a query of two does not ask for their exact mass.
std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> fineBox(const Eigen::Vector3d& sides) {
  TriangleMesh mesh = fcl_prob_test::boxMesh(sides);
  for (int round = 0; round < 3; ++round) {
    TriangleMesh finer;
    for (const fcl::Triangle& t : mesh.triangles) {
      const std::size_t first = finer.vertices.size();
      for (int k = 0; k < 3; ++k) finer.vertices.push_back(mesh.vertices[t[k]]);
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d& next = mesh.vertices[t[(k + 1) % 3]];
        finer.vertices.emplace_back(0.5 * (mesh.vertices[t[k]] + next));
      }
      for (const auto& [i, j, k] : {std::array{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}) {
        finer.triangles.emplace_back(first + i, first + j, first + k);
      }
    }
    mesh = finer;
  }
  return fcl_prob_test::makeModel<fcl::OBBRSSd>(mesh);
}

/// Of rank 1 to 3.
GaussianDisplacement randomSpread(RandomBodies& random) {
  Eigen::Vector3d deviations = Eigen::Vector3d::Zero();
  const int rank = random.integer(1, 3);
  for (int k = 0; k < rank; ++k) deviations[k] = random.logUniform(0.02, 0.6);
  return GaussianDisplacement::fromStandardDeviations(deviations, random.quaternion());
}

}  // namespace

TEST_CASE("estimates of few cells are off by few of their standard errors", "[slow]") {
  RandomBodies random(1);
  int used = 0, few_cells = 0, converged = 0, beyond_three = 0;
  double mean_square = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const auto a = i % 3 == 1 ? randomTriangle(random) : randomBox(random);
    const auto b = randomBox(random);
    const fcl::Transform3d pose_a = random.pose(0.0), pose_b = random.pose(1.5);
    const PreparedQuery query(a, b);
    const GaussianDisplacement displacement = randomSpread(random);
    ProbabilityRequest request;
    request.method = ProbabilityMethod::exact;
    ProbabilityResult exact, estimate;
    query.collisionProbability(pose_a, pose_b, displacement, request, exact);
    if (*exact.upper - *exact.lower > 1e-6) continue;
    request.method = ProbabilityMethod::estimate;
    request.relative_tolerance = random.logUniform(0.01, 0.5);
    request.absolute_tolerance = random.logUniform(1e-6, 0.1);
    request.seed = static_cast<std::uint64_t>(i + 1);
    if (i % 5 == 0) request.max_cells = static_cast<std::size_t>(random.integer(1, 30));
    query.collisionProbability(pose_a, pose_b, displacement, request, estimate);
    const double error = *estimate.standard_error;
    const double off = std::max(
        0.0, std::fabs(*estimate.estimate - exact.probability()) - (*exact.upper - *exact.lower));
    CAPTURE(i, *estimate.estimate, exact.probability(), error, estimate.statistics.cells);
    CHECK(off <= 5.0 * error);
    CHECK(estimate.statistics.cells <= request.max_cells);
    if (estimate.status == ProbabilityStatus::converged) {
      ++converged;
      CHECK(error <=
            std::max(request.absolute_tolerance, request.relative_tolerance * *estimate.estimate));
    }
    if (!(error > 0.0)) continue;
    ++used;
    few_cells += estimate.statistics.cells <= 3;
    beyond_three += off > 3.0 * error;
    mean_square += std::pow(off / error, 2);
  }
  CHECK(used > 1500);
  CHECK(few_cells > 500);
  CHECK(converged > 1000);
  CHECK(beyond_three <= 4);  // of a normal distribution: 6
  CHECK(mean_square / used < 1.0);
}

TEST_CASE("the standard errors of the smallest probabilities do not vanish") {
  const auto box = std::make_shared<fcl::Boxd>(1, 1, 1);
  const auto ball = std::make_shared<fcl::Sphered>(0.5);
  const PreparedQuery query(box, ball);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  int small = 0;
  for (double distance = 2.0; distance < 4.7; distance += 0.15) {
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.translation().x() = distance;
    ProbabilityRequest request;
    request.relative_tolerance = 0.1;
    request.absolute_tolerance = 0.0;
    request.method = ProbabilityMethod::interval;
    ProbabilityResult interval, estimate;
    query.collisionProbability(fcl::Transform3d::Identity(), pose, displacement, request, interval);
    request.method = ProbabilityMethod::estimate;
    query.collisionProbability(fcl::Transform3d::Identity(), pose, displacement, request, estimate);
    CAPTURE(distance, *interval.lower, *interval.upper, *estimate.estimate,
            *estimate.standard_error, toString(estimate.status));
    CHECK(*estimate.standard_error > 0.0);
    CHECK(*estimate.estimate - 5 * *estimate.standard_error <= *interval.upper);
    CHECK(*estimate.estimate + 5 * *estimate.standard_error >= *interval.lower);
    small += *interval.upper < 1e-160;
  }
  CHECK(small >= 5);
}

TEST_CASE("lines of the smallest probabilities are drawn where they matter") {
  // Two boxes as convex meshes, far out along one axis: P is a product of interval masses.
  const auto mesh = fineBox({1.0, 1.2, 0.8});
  const PreparedQuery query(mesh, mesh);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.15, 0.12});
  for (const double height : {20.0, 27.0, 34.0}) {
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.translation() = Eigen::Vector3d(1.0 + 0.1 * height, 1.15, 0.7);
    const double truth = normalTailMass(height) *
                         normalIntervalMass((1.15 - 1.2) / 0.15, (1.15 + 1.2) / 0.15) *
                         normalIntervalMass((0.7 - 0.8) / 0.12, (0.7 + 0.8) / 0.12);
    ProbabilityRequest request;
    request.method = ProbabilityMethod::estimate;
    request.relative_tolerance = 0.01;
    request.absolute_tolerance = 0.0;
    request.contact = ContactMeaning::solid;
    ProbabilityResult result;
    query.collisionProbability(fcl::Transform3d::Identity(), pose, displacement, request, result);
    CAPTURE(height, truth, *result.estimate, *result.standard_error, result.statistics.samples);
    CHECK(std::any_of(result.plan.begin(), result.plan.end(), [](const std::string& note) {
      return note.find("parallel lines") != std::string::npos;
    }));
    CHECK(std::fabs(*result.estimate - truth) <= 4.0 * *result.standard_error);
    CHECK(*result.standard_error <= 0.01 * truth * 1.05);
    CHECK(result.statistics.samples < 2'000);
  }
}
