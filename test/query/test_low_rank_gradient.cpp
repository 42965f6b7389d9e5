// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where A does not move along an axis, P changes with the mean across it all the same: there is a
// gradient that is right in all three components, or none and a sentence that says so.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>

#include <algorithm>

#include "catch.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/mixture.h"
#include "mesh_shapes.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob;
using fcl_prob_test::RandomBodies;

std::shared_ptr<fcl::CollisionGeometryd> randomGeometry(RandomBodies& random) {
  switch (random.integer(0, 2)) {
    case 0:
      return std::make_shared<fcl::Sphered>(random.uniform(0.3, 0.6));
    case 1:
      return std::make_shared<fcl::Boxd>(random.uniform(0.3, 1.0), 0.8, 0.5);
    default:
      return fcl_prob_test::makeModel<fcl::OBBRSSd>(fcl_prob_test::boxMesh({0.7, 0.6, 0.5}));
  }
}

GaussianDisplacement ofRank(int rank, RandomBodies& random) {
  Eigen::Vector3d sigma = Eigen::Vector3d::Zero();
  for (int k = 0; k < rank; ++k) sigma[k] = random.uniform(0.1, 0.4);
  const Eigen::Quaterniond axes =
      random.integer(0, 1) ? random.quaternion() : Eigen::Quaterniond::Identity();
  return GaussianDisplacement::fromStandardDeviations(sigma, axes, 0.3 * random.normalVector());
}

bool saysWhy(const ProbabilityResult& result) {
  const auto says = [](const std::string& line) {
    return line.rfind("no gradient", 0) == 0 || line.find(": no gradient") != std::string::npos ||
           line.find("; no gradient") != std::string::npos;
  };
  return std::any_of(result.plan.begin(), result.plan.end(), says);
}

void checkNone(const ProbabilityResult& result) {
  CHECK_FALSE(result.gradient);
  CHECK_FALSE(result.gradient_lower);
  CHECK_FALSE(result.gradient_upper);
  CHECK_FALSE(result.gradient_standard_error);
  CHECK(saysWhy(result));
}

TEST_CASE("no gradient is claimed for a section, by any method", "[gradient]") {
  RandomBodies random(1210);
  const ProbabilityMethod methods[] = {ProbabilityMethod::automatic, ProbabilityMethod::interval,
                                       ProbabilityMethod::estimate, ProbabilityMethod::monte_carlo};
  for (int i = 0; i < 120; ++i) {
    const auto a = randomGeometry(random), b = randomGeometry(random);
    const fcl::Transform3d pose_a(random.pose(0.3)), pose_b(random.pose(0.3));
    ProbabilityRequest request;
    request.method = methods[i % 4];
    request.gradient = true;
    request.relative_tolerance = 0.1;
    request.samples = 200;
    const int rank = (i / 4) % 3;
    ProbabilityResult result;
    collisionProbability(a.get(), pose_a, b.get(), pose_b, ofRank(rank, random), request, result);
    INFO("case " << i << " rank " << rank << " method " << toString(request.method));
    checkNone(result);
  }
}

TEST_CASE("a mixture with one component of rank 2 has no gradient", "[gradient]") {
  RandomBodies random(1211);
  const fcl::CollisionObjectd a(std::make_shared<fcl::Sphered>(0.5)), b(a);
  ProbabilityRequest request;
  request.gradient = true;
  for (int rank = 0; rank <= 3; ++rank) {
    const GaussianMixture mixture({{0.5, ofRank(3, random)}, {0.5, ofRank(rank, random)}});
    ProbabilityResult result;
    collisionProbability(&a, &b, mixture, request, result);
    if (rank < 3) {
      checkNone(result);
    } else {
      CHECK(result.gradient);
      CHECK_FALSE(saysWhy(result));
    }
  }
}

TEST_CASE("the gradient across a half-space at every rank is that of the closed form",
          "[gradient]") {
  RandomBodies random(1212);
  ProbabilityRequest request;
  request.gradient = true;
  int told = 0;
  for (int i = 0; i < 300; ++i) {
    const auto displacement = ofRank(random.integer(1, 3), random);
    const Eigen::Vector3d normal = random.direction();
    const double radius = random.uniform(0.1, 0.5), offset = random.uniform(-0.5, 0.5);
    const fcl::Sphered sphere(radius);
    const fcl::Halfspaced ground(normal, offset);
    ProbabilityResult result;
    collisionProbability(&sphere, fcl::Transform3d::Identity(), &ground,
                         fcl::Transform3d::Identity(), displacement, request, result);
    // P = Φ((offset + radius - normal·mean) / deviation)
    const double deviation = displacement.standardDeviations()
                                 .cwiseProduct(displacement.axes().transpose() * normal)
                                 .norm();
    const double z = (offset + radius - normal.dot(displacement.mean())) / deviation;
    const double slope = -std::exp(-0.5 * z * z) / (std::sqrt(2 * M_PI) * deviation);
    if (!result.gradient) {
      CHECK(saysWhy(result));
      continue;
    }
    ++told;
    const Eigen::Vector3d truth = slope * normal;
    const Eigen::Array3d rounding = 1e-13 * (1.0 + z * z) * truth.array().abs();
    CHECK((result.gradient_lower->array() <= truth.array() + rounding).all());
    CHECK((result.gradient_upper->array() >= truth.array() - rounding).all());
    CHECK((*result.gradient - truth).norm() <= 1e-9 * (1.0 + truth.norm()));
  }
  CHECK(told > 280);
}

}  // namespace
