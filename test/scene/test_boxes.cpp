// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The partition on box meshes, whose collision probabilities are products of normal masses.
#include <array>
#include <cmath>

#include "catch.h"
#include "fcl_prob/normal_mass.h"
#include "partition_query.h"
#include "random_bodies.h"

namespace {

using fcl_prob::Bounds;
using fcl_prob::GaussianDisplacement;
using fcl_prob::ProbabilityResult;
using fcl_prob_test::boxMesh;
using fcl_prob_test::intervalRequest;
using fcl_prob_test::PartitionQuery;

// Mass of |centre + sigma_k y_k| <= half_k for all k; an axis with sigma 0 is certain.
double boxMass(const Eigen::Vector3d& centre, const Eigen::Vector3d& half,
               const Eigen::Vector3d& sigma) {
  double mass = 1.0;
  for (int k = 0; k < 3; ++k) {
    if (sigma[k] == 0.0) {
      if (std::fabs(centre[k]) > half[k]) mass = 0.0;
      continue;
    }
    mass *= fcl_prob::normalIntervalMass((-half[k] - centre[k]) / sigma[k],
                                         (half[k] - centre[k]) / sigma[k]);
  }
  return mass;
}

// Two boxes with parallel sides, everything turned by `world`: as surfaces they meet where the
// solids do, except where one box is inside the other.
struct BoxScene {
  Eigen::Vector3d sides_a, sides_b, offset, sigma;
  Eigen::Quaterniond world = Eigen::Quaterniond::Identity();

  PartitionQuery query() const {
    PartitionQuery query(boxMesh(sides_a), boxMesh(sides_b));
    query.pose_a.linear() = query.pose_b.linear() = world.toRotationMatrix();
    query.pose_b.translation() = world * offset;
    return query;
  }
  GaussianDisplacement displacement() const {
    return GaussianDisplacement::fromStandardDeviations(sigma, world);
  }
  double solidMass() const { return boxMass(offset, 0.5 * (sides_a + sides_b), sigma); }
  double surfaceMass() const {
    double nested = 0.0;
    for (const double sign : {1.0, -1.0}) {
      const Eigen::Vector3d half = 0.5 * sign * (sides_a - sides_b);
      if ((half.array() > 0).all()) nested = boxMass(offset, half, sigma);
    }
    return solidMass() - nested;
  }
};

BoxScene randomScene(fcl_prob_test::RandomBodies& random) {
  BoxScene scene;
  for (int k = 0; k < 3; ++k) {
    scene.sides_a[k] = random.logUniform(0.05, 2.0);
    scene.sides_b[k] = random.logUniform(0.05, 2.0);
    scene.sigma[k] = random.logUniform(0.03, 1.0);
  }
  scene.offset = random.uniform(0.0, 3.0) * random.direction();
  scene.world = random.quaternion();
  return scene;
}

}  // namespace

TEST_CASE("the interval holds the product of normal masses of boxes", "[boxes]") {
  fcl_prob_test::RandomBodies random(7);
  std::array<int, 4> decades{};
  int nested = 0;
  for (int i = 0; i < 150; ++i) {
    const BoxScene scene = randomScene(random);
    const double truth = scene.surfaceMass();
    if (truth < 1e-9) continue;
    const ProbabilityResult result = scene.query().run(scene.displacement(), intervalRequest(0.02));
    INFO("scene " << i << ", P " << truth);
    // The truth is itself rounded, more so as a difference.
    const double rounding = 1e-12 * scene.solidMass();
    CHECK(*result.lower <= truth + rounding);
    CHECK(*result.upper >= truth - rounding);
    CHECK(result.status != fcl_prob::ProbabilityStatus::cell_limit);
    ++decades[static_cast<std::size_t>(truth > 0.1 ? 0 : truth > 1e-2 ? 1 : truth > 1e-4 ? 2 : 3)];
    if (truth < scene.solidMass() * (1 - 1e-9)) ++nested;
  }
  CHECK(decades[0] > 10);
  CHECK(decades[1] > 5);
  CHECK(decades[2] > 5);
  CHECK(decades[3] > 5);
  CHECK(nested > 2);
}

TEST_CASE("the interval is as tight as asked for, down to rounding", "[boxes]") {
  BoxScene scene;
  scene.sides_a = {1.0, 0.5, 0.4};
  scene.sides_b = {0.6, 0.8, 0.3};
  scene.offset = {1.0, 0.1, 0.05};
  scene.sigma = {0.1, 0.2, 0.15};
  scene.world = Eigen::Quaterniond(0.3, 0.5, -0.2, 0.7).normalized();
  const double truth = scene.surfaceMass();
  for (const double tolerance : {1e-1, 1e-3, 1e-6}) {
    const ProbabilityResult result =
        scene.query().run(scene.displacement(), intervalRequest(tolerance));
    INFO("tolerance " << tolerance << ": " << truth - *result.lower << " below, "
                      << *result.upper - truth << " above");
    CHECK(*result.upper - *result.lower <= tolerance * *result.upper);
    CHECK(*result.lower <= truth * (1 + 1e-14));
    CHECK(*result.upper >= truth * (1 - 1e-14));
  }
}

TEST_CASE("rare events keep their relative accuracy", "[boxes]") {
  BoxScene scene;
  scene.sides_a = {1.0, 0.5, 0.4};
  scene.sides_b = {0.6, 0.8, 0.3};
  scene.sigma = {0.1, 0.1, 0.1};
  scene.world = Eigen::Quaterniond(0.3, 0.5, -0.2, 0.7).normalized();
  for (const double gap : {0.5, 0.7, 1.0, 2.0, 3.5}) {  // 5 to 35 standard deviations
    scene.offset = {0.8 + gap, 0.1, 0.05};
    const double truth = scene.surfaceMass();
    const ProbabilityResult result = scene.query().run(scene.displacement(), intervalRequest(0.1));
    INFO("P " << truth << " in " << *result.lower << " .. " << *result.upper);
    CHECK(result.status == fcl_prob::ProbabilityStatus::converged);
    CHECK(*result.lower <= truth * (1 + 1e-12));
    CHECK(*result.upper >= truth * (1 - 1e-12));
  }
}

TEST_CASE("missing axes of the covariance are left out", "[boxes]") {
  fcl_prob_test::RandomBodies random(11);
  std::array<int, 3> tested{};
  for (int i = 0; i < 90; ++i) {
    BoxScene scene = randomScene(random);
    const int rank = i % 3;
    scene.offset *= 0.4;  // so that the directions that do not move miss less often
    for (int k = rank; k < 3; ++k) scene.sigma[k] = 0.0;
    const double truth = scene.surfaceMass();
    const ProbabilityResult result = scene.query().run(scene.displacement(), intervalRequest(1e-3));
    INFO("rank " << rank << ", P " << truth);
    CHECK(*result.lower <= truth + 1e-12);
    CHECK(*result.upper >= truth - 1e-12);
    CHECK(*result.upper - *result.lower <= 1e-3 * *result.upper + 1e-300);
    if (rank == 0 || (truth > 1e-6 && truth < 1)) ++tested[static_cast<std::size_t>(rank)];
  }
  CHECK(tested[0] == 30);
  CHECK(tested[1] > 5);
  CHECK(tested[2] > 5);
}

TEST_CASE("solids that contain each other collide", "[boxes]") {
  BoxScene scene;
  scene.sides_a = {0.2, 0.3, 0.25};
  scene.sides_b = {1.0, 0.9, 0.8};
  scene.offset = {0.2, 0.1, 0.0};
  scene.sigma = {0.3, 0.25, 0.2};
  scene.world = Eigen::Quaterniond(0.3, 0.5, -0.2, 0.7).normalized();
  for (const bool swapped : {false, true}) {
    if (swapped) std::swap(scene.sides_a, scene.sides_b);
    PartitionQuery query = scene.query();
    const ProbabilityResult surfaces = query.run(scene.displacement(), intervalRequest(1e-3));
    query.makeSolid();
    const ProbabilityResult solids = query.run(scene.displacement(), intervalRequest(1e-3));
    CHECK(Bounds{*surfaces.lower, *surfaces.upper}.contains(scene.surfaceMass()));
    INFO("solids " << *solids.lower << " .. " << *solids.upper << ", truth " << scene.solidMass()
                   << ", missing " << scene.solidMass() - *solids.upper);
    CHECK(Bounds{*solids.lower, *solids.upper}.contains(scene.solidMass()));
    CHECK(*solids.lower > *surfaces.upper);
  }
}

TEST_CASE("the gradient of boxes is that of the product", "[boxes]") {
  BoxScene scene;
  scene.sides_a = {1.0, 0.5, 0.4};
  scene.sides_b = {0.6, 0.8, 0.3};
  scene.offset = {0.95, 0.3, -0.2};
  scene.sigma = {0.1, 0.2, 0.15};
  scene.world = Eigen::Quaterniond(0.3, 0.5, -0.2, 0.7).normalized();
  auto request = intervalRequest(1e-4);
  request.gradient = true;
  const ProbabilityResult result = scene.query().run(scene.displacement(), request);
  Eigen::Vector3d truth;
  for (int k = 0; k < 3; ++k) {
    const double step = 1e-5;
    BoxScene before = scene;
    BoxScene after = scene;
    // Moving A by +step is moving B by -step.
    before.offset[k] += step;
    after.offset[k] -= step;
    truth[k] = (after.surfaceMass() - before.surfaceMass()) / (2 * step);
  }
  truth = scene.world * truth;
  CHECK((*result.gradient - truth).norm() <= 1e-3 * truth.norm());
  for (int k = 0; k < 3; ++k) {
    CHECK((*result.gradient_lower)[k] <= truth[k] + 1e-7);
    CHECK((*result.gradient_upper)[k] >= truth[k] - 1e-7);
  }
}
