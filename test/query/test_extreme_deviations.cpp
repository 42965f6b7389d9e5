// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Deviations as small as doubles go beside others that are not: P is that of what moves, to within
// what positions are rounded by, and takes no longer.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>

#include <cmath>
#include <string>
#include <vector>

#include "catch.h"
#include "fcl_prob/fcl_prob.h"
#include "fcl_prob/normal_mass.h"
#include "mesh_shapes.h"
#include "poses.h"
#include "random_bodies.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace extreme_deviations {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

constexpr double kTiny[] = {1e-18, 1e-20, 1e-40, 1e-80, 1e-110, 1e-155, 1e-200, 1e-299};

struct NamedPair {
  std::string name;
  Geometry a, b;
};

std::vector<NamedPair> pairs() {
  const Geometry box = std::make_shared<fcl::Boxd>(1, 0.5, 0.7);
  const Geometry ball = std::make_shared<fcl::Sphered>(0.5);
  const Geometry cylinder = std::make_shared<fcl::Cylinderd>(0.5, 1.0);
  const Geometry rod = std::make_shared<fcl::Capsuled>(0.2, 1.0);
  const Geometry egg = std::make_shared<fcl::Ellipsoidd>(0.5, 0.3, 0.4);
  const Geometry bumpy = makeModel<fcl::OBBRSSd>(bumpyMesh(0.5, 5, 8, 1));
  const Geometry torus = makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 10, 6));
  return {{"boxes", box, box},
          {"balls", ball, ball},
          {"ball and box", ball, box},
          {"curved", cylinder, rod},
          {"egg and box", egg, box},
          {"meshes", bumpy, torus},
          {"mesh and ball", bumpy, ball},
          {"mesh and cylinder", torus, cylinder}};
}

/// Two of the three axes, one, or none move.
std::vector<Eigen::Vector3d> movingDeviations() {
  return {{0.3, 0.2, 0.0}, {0.0, 0.25, 0.3}, {0.3, 0.0, 0.0}, {0.0, 0.0, 0.0}};
}

Eigen::Vector3d withTiny(const Eigen::Vector3d& moving, double tiny) {
  Eigen::Vector3d sigma = moving;
  for (int k = 0; k < 3; ++k) {
    if (sigma[k] == 0.0) sigma[k] = tiny / (k + 1.0);
  }
  return sigma;
}

TEST_CASE("what a tiny deviation moves is within rounding: P is that of the others", "[query]") {
  RandomBodies random(1);
  int some = 0;
  for (const NamedPair& pair : pairs()) {
    const PreparedQuery query(pair.a, pair.b);
    for (const Eigen::Vector3d& moving : movingDeviations()) {
      fcl::Transform3d pose = kIdentity;
      pose.linear() = random.rotation();
      pose.translation() = random.uniform(0.5, 0.9) * random.direction();
      const Eigen::Quaterniond axes = random.quaternion();
      ProbabilityRequest request;
      request.max_cells = 20'000;
      ProbabilityResult flat;
      query.collisionProbability(pose, kIdentity,
                                 GaussianDisplacement::fromStandardDeviations(moving, axes),
                                 request, flat);
      some += *flat.lower > 0.01 && *flat.upper < 0.99;
      for (const double tiny : kTiny) {
        const auto displacement =
            GaussianDisplacement::fromStandardDeviations(withTiny(moving, tiny), axes);
        for (const auto method : {ProbabilityMethod::automatic, ProbabilityMethod::interval,
                                  ProbabilityMethod::estimate}) {
          request.method = method;
          ProbabilityResult result;
          query.collisionProbability(pose, kIdentity, displacement, request, result);
          CAPTURE(pair.name, moving.transpose(), tiny, toString(method), toString(result.status),
                  *result.lower, *result.upper, *flat.lower, *flat.upper, result.statistics.cells);
          CHECK(*result.lower <= *flat.upper * (1.0 + 1e-12));
          CHECK(*result.upper >= *flat.lower * (1.0 - 1e-12));
          CHECK(result.statistics.cells < 6'000);
          // Cells of one point do not tell on which side of a curved surface it is.
          const bool is_point = moving.isZero() && pair.name.find("mesh and") == 0;
          if (is_point && result.status == ProbabilityStatus::resolution_limit) continue;
          const double error = method == ProbabilityMethod::estimate
                                   ? *result.standard_error
                                   : *result.upper - *result.lower;
          CHECK(error <= std::max(1e-6, 0.0101 * *result.upper));
          if (result.estimate) {
            CHECK(*result.estimate >= *flat.lower - 6.0 * *result.standard_error - 1e-9);
            CHECK(*result.estimate <= *flat.upper + 6.0 * *result.standard_error + 1e-9);
          }
        }
      }
    }
  }
  CHECK(some > 10);
}

TEST_CASE("boxes along the axes: a product, whatever the deviations", "[query]") {
  RandomBodies random(2);
  const Geometry box = std::make_shared<fcl::Boxd>(1, 0.5, 0.7);
  const PreparedQuery query(box, box);
  for (int i = 0; i < 60; ++i) {
    Eigen::Vector3d sigma, offset;
    double p = 1.0;
    for (int k = 0; k < 3; ++k) {
      const double size = Eigen::Vector3d(1, 0.5, 0.7)[k];
      sigma[k] = random.integer(0, 2) == 0 ? random.logUniform(0.1, 1.0)
                                           : random.logUniform(1e-298, 1e-14);
      offset[k] = size * random.uniform(0.0, 1.3);
      p *= normalIntervalMass((-offset[k] - size) / sigma[k], (-offset[k] + size) / sigma[k]);
    }
    for (const auto method : {ProbabilityMethod::automatic, ProbabilityMethod::interval}) {
      ProbabilityRequest request;
      request.method = method;
      request.max_cells = 20'000;
      ProbabilityResult result;
      query.collisionProbability(at(offset), kIdentity,
                                 GaussianDisplacement::fromStandardDeviations(sigma), request,
                                 result);
      CAPTURE(i, sigma.transpose(), offset.transpose(), p, toString(method), *result.lower,
              *result.upper, result.statistics.cells);
      CHECK(*result.lower <= p * (1.0 + 1e-12));
      CHECK(*result.upper >= p * (1.0 - 1e-12));
      CHECK(*result.upper - *result.lower <= std::max(1e-6, 0.01 * *result.upper));
    }
  }
}

// On which side of the section the mass is depends on more digits than positions have.
TEST_CASE("faces that touch where nearly nothing moves: certified, and soon over", "[query]") {
  const Geometry box = std::make_shared<fcl::Boxd>(1, 1, 1);
  const Geometry mesh = makeModel<fcl::OBBRSSd>(boxMesh({1, 1, 1}));
  for (const Geometry& b : {box, mesh}) {
    const PreparedQuery query(mesh, b);
    for (const double tiny : kTiny) {
      for (const Eigen::Vector3d& sigma :
           {Eigen::Vector3d(tiny, 0.3, 0.3), Eigen::Vector3d(tiny, tiny, 0.3)}) {
        ProbabilityRequest request;
        request.method = ProbabilityMethod::interval;
        request.max_cells = 20'000;
        ProbabilityResult result;
        query.collisionProbability(at(1, 0, 0), kIdentity,
                                   GaussianDisplacement::fromStandardDeviations(sigma), request,
                                   result);
        const double across = normalIntervalMass(-1 / 0.3, 1 / 0.3);
        const double p = 0.5 * (sigma[1] > 0.1 ? across * across : across);
        CAPTURE(sigma.transpose(), *result.lower, *result.upper, toString(result.status));
        CHECK(*result.lower <= p);
        CHECK(*result.upper >= p);
        CHECK(result.statistics.cells < 10'000);
        CHECK(result.status == ProbabilityStatus::resolution_limit);
      }
    }
  }
}

}  // namespace extreme_deviations
