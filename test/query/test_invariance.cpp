// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// P does not depend on which object is called A, on the world frame, or on the unit of length.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>

#include <functional>
#include <random>

#include "catch.h"
#include "fcl_prob/fcl_prob.h"
#include "mesh_shapes.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

/// Makes a geometry in a unit of length: the same shape with all lengths multiplied by `scale`.
using Maker = std::function<Geometry(double scale)>;

struct Scene {
  Maker a, b;
  fcl::Transform3d pose_a, pose_b;
  GaussianDisplacement displacement;
  double scale = 1.0;
};

fcl::Transform3d scaledPose(fcl::Transform3d pose, double scale) {
  pose.translation() *= scale;
  return pose;
}

Scene swapped(const Scene& scene) {
  return {scene.b, scene.a, scene.pose_b, scene.pose_a, scene.displacement.reversed(), scene.scale};
}

Scene turned(const Scene& scene, const fcl::Transform3d& world) {
  return {scene.a,
          scene.b,
          world * scene.pose_a,
          world * scene.pose_b,
          scene.displacement.rotated(world.linear()),
          scene.scale};
}

Scene inOtherUnit(const Scene& scene, double scale) {
  const GaussianDisplacement& d = scene.displacement;
  return {scene.a,
          scene.b,
          scaledPose(scene.pose_a, scale),
          scaledPose(scene.pose_b, scale),
          GaussianDisplacement::fromStandardDeviations(
              scale * d.standardDeviations(), Eigen::Quaterniond(d.axes()), scale * d.mean()),
          scene.scale * scale};
}

ProbabilityResult answer(const Scene& scene, ProbabilityMethod method, double tolerance) {
  ProbabilityRequest request;
  request.method = method;
  request.relative_tolerance = tolerance;
  request.absolute_tolerance = 0.0;
  ProbabilityResult result;
  PreparedQuery(scene.a(scene.scale), scene.b(scene.scale))
      .collisionProbability(scene.pose_a, scene.pose_b, scene.displacement, request, result);
  return result;
}

std::vector<Scene> variantsOf(const Scene& scene, std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  const auto number = [&] { return normal(generator); };
  fcl::Transform3d world;
  world = Eigen::Quaterniond(number(), number(), number(), number()).normalized();
  world.translation() << number(), number(), number();
  return {swapped(scene), turned(scene, world), inOtherUnit(scene, 1000.0),
          inOtherUnit(turned(swapped(scene), world), 1e-3)};
}

Geometry convexOf(const TriangleMesh& mesh) {
  auto vertices = std::make_shared<std::vector<Eigen::Vector3d>>(mesh.vertices);
  auto faces = std::make_shared<std::vector<int>>();
  for (const auto& t : mesh.triangles) {
    faces->push_back(3);
    for (int k = 0; k < 3; ++k) faces->push_back(static_cast<int>(t[k]));
  }
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(mesh.triangles.size()), faces);
}

TriangleMesh scaled(TriangleMesh mesh, double scale) {
  for (auto& v : mesh.vertices) v *= scale;
  return mesh;
}

/// Random poses, standard deviations and a mean; P from nearly 0 to nearly 1.
Scene randomScene(const Maker& a, const Maker& b, std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(-2.0, -0.3);
  const auto number = [&] { return normal(generator); };
  const auto rotation = [&] {
    return Eigen::Quaterniond(number(), number(), number(), number()).normalized();
  };
  Scene scene{a, b, {}, {}, GaussianDisplacement()};
  scene.pose_a = rotation();
  scene.pose_a.translation() << number(), number(), number();
  scene.pose_b = rotation();
  scene.pose_b.translation() =
      scene.pose_a.translation() + 0.8 * Eigen::Vector3d(number(), number(), number());
  const Eigen::Vector3d sigma(std::pow(10.0, exponent(generator)),
                              std::pow(10.0, exponent(generator)),
                              std::pow(10.0, exponent(generator)));
  scene.displacement = GaussianDisplacement::fromStandardDeviations(
      sigma, rotation(), 0.1 * Eigen::Vector3d(number(), number(), number()));
  return scene;
}

const Maker kBox = [](double s) { return std::make_shared<fcl::Boxd>(s * 1.0, s * 0.6, s * 0.4); };
const Maker kHull = [](double s) { return convexOf(scaled(sphereMesh(0.4, 5, 7), s)); };
const Maker kBumps = [](double s) {
  return makeModel<fcl::OBBRSSd>(scaled(bumpyMesh(0.4, 6, 9, 3), s));
};
const Maker kTorus = [](double s) {
  return makeModel<fcl::OBBRSSd>(scaled(torusMesh(0.5, 0.2, 9, 6), s));
};

}  // namespace

TEST_CASE("bounds of convex shapes do not change with the frame, the order and the unit") {
  std::mt19937_64 generator(21);
  int likely = 0;
  int rare = 0;
  for (int i = 0; i < 200; ++i) {
    const Scene scene = randomScene(i % 2 ? kBox : kHull, kBox, generator);
    const double p = *answer(scene, ProbabilityMethod::convex_pcd, 0.01).upper;
    likely += p > 0.1;
    rare += p < 1e-3;
    // The direction of the half-space comes from an iteration that stops at a tolerance.
    for (const Scene& variant : variantsOf(scene, generator)) {
      REQUIRE(*answer(variant, ProbabilityMethod::convex_pcd, 0.01).upper ==
              Approx(p).epsilon(1e-6).margin(1e-20));
    }
  }
  CHECK(likely > 40);
  CHECK(rare > 40);
}

TEST_CASE("P of convex shapes does not change with the frame, the order and the unit") {
  std::mt19937_64 generator(23);
  int likely = 0;
  int rare = 0;
  for (int i = 0; i < 100; ++i) {
    const Scene scene = randomScene(i % 2 ? kBox : kHull, kBox, generator);
    const double p = answer(scene, ProbabilityMethod::exact, 0.01).probability();
    if (p < 1e-290) continue;
    likely += p > 0.1;
    rare += p < 1e-3;
    for (const Scene& variant : variantsOf(scene, generator)) {
      REQUIRE(answer(variant, ProbabilityMethod::exact, 0.01).probability() ==
              Approx(p).epsilon(1e-9).margin(0.0));
    }
  }
  CHECK(likely > 15);
  CHECK(rare > 15);
}

TEST_CASE("intervals of meshes agree in every frame, order and unit") {
  std::mt19937_64 generator(22);
  int between = 0;
  const int count = 24;
  for (int i = 0; i < count; ++i) {
    const Scene scene = randomScene(kBumps, i % 2 ? kBox : kTorus, generator);
    const ProbabilityResult reference = answer(scene, ProbabilityMethod::interval, 0.05);
    if (*reference.upper < 1e-6) continue;  // a tolerance relative to nearly nothing is a long way
    between += *reference.upper < 0.99;
    for (const Scene& variant : variantsOf(scene, generator)) {
      const ProbabilityResult result = answer(variant, ProbabilityMethod::interval, 0.05);
      INFO("scene " << i << ": [" << *reference.lower << ", " << *reference.upper << "] and ["
                    << *result.lower << ", " << *result.upper << "]");
      REQUIRE(*result.lower <= *reference.upper);
      REQUIRE(*result.upper >= *reference.lower);
      REQUIRE(*result.upper - *result.lower <= 0.0501 * *result.upper);
    }
  }
  CHECK(between > count / 4);
}
