// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Boxes as closed meshes, of any size in deviations and so far that P is no double, against
// products of Φ in 50 digits.
#include "catch.h"
#include "fcl_prob/collision_probability.h"
#include "high_precision.h"
#include "mesh_shapes.h"
#include "random_bodies.h"
#include "shapes.h"

namespace {

using namespace fcl_prob;
using namespace fcl_prob_test;

Eigen::Vector3d sides(RandomBodies& random) {
  return {random.uniform(0.2, 1.0), random.uniform(0.2, 1.0), random.uniform(0.2, 1.0)};
}

/// Two boxes along the axes, apart along the first `apart` of them by `deviations` in all.
struct FarBoxes {
  FarBoxes(RandomBodies& random, double deviations, int apart)
      : a(sides(random)), b(sides(random)), sigma(0.5 * sides(random)) {
    place(random, deviations, apart);
  }

  void place(RandomBodies& random, double deviations, int apart) {
    for (int k = 0; k < 3; ++k) {
      const double touching = 0.5 * (a[k] + b[k]);
      offset[k] = k < apart ? touching + sigma[k] * deviations / std::sqrt(apart)
                            : random.uniform(-touching, touching);
    }
  }

  HighPrecision truth() const {
    HighPrecision product = 1;
    for (int k = 0; k < 3; ++k) {
      const HighPrecision half = (HighPrecision(a[k]) + b[k]) / 2,
                          middle = abs(HighPrecision(offset[k]));
      product *= trueIntervalMass((middle - half) / sigma[k], (middle + half) / sigma[k]);
    }
    return product;
  }

  ProbabilityResult ask(const ProbabilityRequest& request) const {
    const auto model_a = makeModel<fcl::OBBRSSd>(boxMesh(a));
    const auto model_b = makeModel<fcl::OBBRSSd>(boxMesh(b));
    fcl::Transform3d pose_b = fcl::Transform3d::Identity();
    pose_b.translation() = offset;
    ProbabilityResult result;
    collisionProbability(model_a.get(), fcl::Transform3d::Identity(), model_b.get(), pose_b,
                         GaussianDisplacement::fromStandardDeviations(sigma), request, result);
    return result;
  }

  Eigen::Vector3d a, b, sigma, offset;
};

TEST_CASE("convex meshes up to 52 deviations apart: the bounds hold 50 digits") {
  RandomBodies random(38);
  int by_polytopes = 0;
  for (int i = 0; i < 200; ++i) {
    const double deviations = i % 2 ? random.uniform(36.0, 44.0) : random.uniform(0.0, 52.0);
    const FarBoxes boxes(random, deviations, 1 + i % 3);
    ProbabilityRequest request;
    request.method = ProbabilityMethod::interval;
    request.contact = ContactMeaning::solid;
    request.relative_tolerance = 0.1;
    request.absolute_tolerance = 0.0;
    request.max_cells = 1500;
    const ProbabilityResult result = boxes.ask(request);
    const HighPrecision truth = boxes.truth();
    CAPTURE(i, deviations, truth.str(6), *result.lower, *result.upper);
    CHECK(HighPrecision(*result.lower) <= truth);
    CHECK(HighPrecision(*result.upper) >= truth);
    for (const std::string& note : result.plan) {
      by_polytopes += note.find("along the C-obstacles' own planes") != std::string::npos;
    }
  }
  CHECK(by_polytopes > 20);
}

// What is inside may be millions of deviations wide then.
TEST_CASE("convex meshes of up to 1e8 deviations: the bounds hold 50 digits, after few cells") {
  RandomBodies random(39);
  for (int i = 0; i < 100; ++i) {
    FarBoxes boxes(random, 0.0, 0);
    boxes.sigma *= random.logUniform(1e-8, 1.0);
    boxes.place(random, random.uniform(-3.0, 3.0), i % 4);
    ProbabilityRequest request;
    request.method = ProbabilityMethod::interval;
    request.contact = ContactMeaning::solid;
    request.relative_tolerance = 0.1;
    const ProbabilityResult result = boxes.ask(request);
    const HighPrecision truth = boxes.truth();
    CAPTURE(i, boxes.sigma, truth.str(6), *result.lower, *result.upper);
    CHECK(HighPrecision(*result.lower) <= truth);
    CHECK(HighPrecision(*result.upper) >= truth);
    CHECK(result.status == ProbabilityStatus::converged);
    CHECK(result.statistics.cells < 5000);
  }
}

}  // namespace
