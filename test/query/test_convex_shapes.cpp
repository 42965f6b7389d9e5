// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex shapes of many faces beside meshes, which the partition takes whole.
#include <fcl/geometry/shape/convex.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "catch.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/convex_polytope.h"
#include "fcl_prob/triangle_mesh.h"
#include "mesh_shapes.h"
#include "random_bodies.h"

using fcl_prob::ContactMeaning;
using fcl_prob::ProbabilityMethod;
using fcl_prob::ProbabilityRequest;
using fcl_prob::ProbabilityResult;
using fcl_prob_test::RandomBodies;

namespace {

std::shared_ptr<const fcl::Convexd> convexOf(const std::vector<Eigen::Vector3d>& points) {
  const fcl_prob::ConvexPolytope hull = fcl_prob::convexHull(points);
  auto faces = std::make_shared<std::vector<int>>();
  for (const fcl_prob::ConvexPolytope::Face& face : hull.faces) {
    faces->push_back(static_cast<int>(face.vertices.size()));
    faces->insert(faces->end(), face.vertices.begin(), face.vertices.end());
  }
  return std::make_shared<fcl::Convexd>(
      std::make_shared<const std::vector<Eigen::Vector3d>>(hull.vertices),
      static_cast<int>(hull.faces.size()), faces);
}

bool isWhole(const ProbabilityResult& result) {
  return std::any_of(result.plan.begin(), result.plan.end(), [](const std::string& line) {
    return line.find("is convex: one piece of") != std::string::npos;
  });
}

struct Scene {
  std::shared_ptr<const fcl::CollisionGeometryd> shape;
  std::shared_ptr<const fcl::CollisionGeometryd> mesh;
  fcl::Transform3d pose_of_shape = fcl::Transform3d::Identity();
  fcl::Transform3d pose_of_mesh = fcl::Transform3d::Identity();
  fcl_prob::GaussianDisplacement displacement;
  bool swapped;

  ProbabilityResult answer(const ProbabilityRequest& request) const {
    ProbabilityResult result;
    if (swapped) {
      fcl_prob::collisionProbability(mesh.get(), pose_of_mesh, shape.get(), pose_of_shape,
                                     displacement, request, result);
    } else {
      fcl_prob::collisionProbability(shape.get(), pose_of_shape, mesh.get(), pose_of_mesh,
                                     displacement, request, result);
    }
    return result;
  }
};

// Now and then the mesh fits into the shape, or the shape into the mesh.
Scene randomScene(RandomBodies& random, int i) {
  const double size = i % 5 == 0 ? 0.6 : 0.15;
  const double radius = i % 5 == 0 ? 0.1 : 0.4;
  const auto displacement = fcl_prob::GaussianDisplacement::fromStandardDeviations(
      {random.uniform(0.03, 0.2), random.uniform(0.03, 0.2), random.uniform(0.03, 0.2)},
      random.quaternion());
  const auto seed = static_cast<std::uint64_t>(i);
  Scene scene{convexOf(random.onSphere(10 + 3 * (i % 17), size)),
              fcl_prob::buildModel<fcl::OBBRSSd>(
                  fcl_prob_test::bumpyMesh(radius, 8 + i % 5, 10 + i % 7, seed)),
              fcl::Transform3d::Identity(),
              fcl::Transform3d::Identity(),
              displacement,
              i % 2 == 1};
  scene.pose_of_shape.linear() = random.rotation();
  scene.pose_of_mesh.linear() = random.rotation();
  scene.pose_of_mesh.translation() = random.uniform(0.0, 0.8) * random.direction();
  return scene;
}

void checkScenes(int scenes, std::size_t samples, unsigned seed) {
  RandomBodies random(seed);
  int whole = 0, representative = 0, limited = 0;
  for (int i = 0; i < scenes; ++i) {
    const Scene scene = randomScene(random, i);
    ProbabilityRequest request;
    request.method = ProbabilityMethod::interval;
    request.contact = i % 3 == 0 ? ContactMeaning::solid : ContactMeaning::fcl;
    request.max_cells = 20'000;
    const ProbabilityResult result = scene.answer(request);
    limited += result.status == fcl_prob::ProbabilityStatus::cell_limit;
    whole += isWhole(result);
    ProbabilityRequest sampled = request;
    sampled.method = ProbabilityMethod::monte_carlo;
    sampled.samples = samples;
    sampled.relative_tolerance = 1e-9;
    sampled.absolute_tolerance = 1e-9;
    sampled.seed = seed + static_cast<unsigned>(i);
    const double p = *scene.answer(sampled).estimate;
    const double count = static_cast<double>(samples);
    const double middle = 0.5 * (*result.lower + *result.upper);
    const double error = 5 * std::sqrt(std::max(middle * (1 - middle), 10.0 / count) / count);
    CAPTURE(i, isWhole(result), *result.lower, *result.upper, p);
    CHECK(p >= *result.lower - error);
    CHECK(p <= *result.upper + error);
    representative += p > 0.01 && p < 0.99;
    // An estimate tests its samples against the shape taken whole.
    request.method = ProbabilityMethod::estimate;
    const ProbabilityResult estimate = scene.answer(request);
    CHECK(std::fabs(*estimate.estimate - middle) <=
          6 * *estimate.standard_error + 0.5 * (*result.upper - *result.lower));
  }
  CHECK(limited <= scenes / 10);
  CHECK(whole > scenes / 2);
  CHECK(representative > scenes / 3);
}

}  // namespace

TEST_CASE("convex shapes of many faces are taken whole and hold what FCL counts", "[convex]") {
  checkScenes(40, 2'000, 3);
}

TEST_CASE("convex shapes of many faces hold what FCL counts in 2,000 scenes", "[convex][long]") {
  checkScenes(2'000, 2'000, 4);
}

TEST_CASE("boxes stay with the slabs of their few faces", "[convex]") {
  RandomBodies random(5);
  Scene scene = randomScene(random, 1);
  scene.shape = convexOf({{0.1, 0.2, 0.1},
                          {-0.1, 0.2, 0.1},
                          {0.1, -0.2, 0.1},
                          {-0.1, -0.2, 0.1},
                          {0.1, 0.2, -0.1},
                          {-0.1, 0.2, -0.1},
                          {0.1, -0.2, -0.1},
                          {-0.1, -0.2, -0.1}});
  ProbabilityRequest request;
  request.method = ProbabilityMethod::interval;
  CHECK_FALSE(isWhole(scene.answer(request)));
}
