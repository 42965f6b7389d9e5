// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Families of one triangle, spheres, half-spaces and mixtures.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>

#include <cmath>

#include "bench/stability_case.h"

namespace fcl_prob::cli {
namespace {

using Eigen::Vector3d;
using Method = ProbabilityMethod;

/// The corners (0, 0, 0), (width, 0, 0) and (0, height, 0).
std::shared_ptr<const fcl::CollisionGeometryd> oneTriangle(double width, double height) {
  TriangleMesh mesh;
  mesh.vertices = {Vector3d::Zero(), {width, 0, 0}, {0, height, 0}};
  mesh.triangles.emplace_back(0, 1, 2);
  return buildModel<fcl::OBBRSSd>(mesh);
}

/// The same triangle, from z = -depth to depth.
std::shared_ptr<const fcl::CollisionGeometryd> prism(double width, double height, double depth) {
  auto vertices = std::make_shared<std::vector<Vector3d>>();
  for (const double z : {-depth, depth}) {
    vertices->insert(vertices->end(), {{0, 0, z}, {width, 0, z}, {0, height, z}});
  }
  const auto faces = std::make_shared<const std::vector<int>>(
      std::vector<int>{3, 0, 2, 1, 3, 3, 4, 5, 4, 0, 1, 4, 3, 4, 1, 2, 5, 4, 4, 2, 0, 3, 5});
  return std::make_shared<fcl::Convexd>(vertices, 5, faces);
}

/// A right triangle, or a prism over it, and a box around `at` from the mean.
struct TriangleScene {
  double width, height, depth;
  Vector3d half, at, sigma;

  /// The C-obstacle is a box without a corner of its section with a plane z = const.
  Precise truth() const {
    const auto mass = [&](int axis, double below, double beyond) {
      const Precise lo = Precise(at[axis]) - half[axis] - below;
      const Precise hi = Precise(at[axis]) + half[axis] + beyond;
      return AxisRange{lo, hi, sigma[axis]}.mass();
    };
    const Precise x = Precise(at.x()) - half.x() - width, y = Precise(at.y()) - half.y() - height;
    const SlantedStrip strip{x, y, width, height, Precise(at.y()) + half.y(), sigma.x(), sigma.y()};
    return (mass(0, 0, 0) * mass(1, height, 0) + strip.mass()) * mass(2, depth, depth);
  }
};

StabilityCase triangleCase(const TriangleScene& scene) {
  StabilityCase result;
  result.a = scene.depth > 0 ? prism(scene.width, scene.height, scene.depth)
                             : oneTriangle(scene.width, scene.height);
  result.b = std::make_shared<fcl::Boxd>(Vector3d(2 * scene.half));
  result.pose_b.translation() = scene.at;
  result.displacement = {{1.0, GaussianDisplacement::fromStandardDeviations(scene.sigma)}};
  result.truth.lower = result.truth.upper = scene.truth();
  return result;
}

StabilityCase meshOfOneTriangle(StabilityRandom& random) {
  TriangleScene scene{random.logUniform(1e-6, 2),
                      random.logUniform(1e-6, 2),
                      0.0,
                      random.uniformVector(0.2, 1),
                      {},
                      random.uniformVector(0.05, 0.5)};
  scene.at = (scene.half + scene.sigma).cwiseProduct(random.uniformVector(-1.2, 1.2));
  return triangleCase(scene);
}

StabilityCase prismAndBox(StabilityRandom& random) {
  const double size = random.logUniform(1e-3, 1e3);
  TriangleScene scene{size * random.uniform(0.2, 1),
                      size * random.uniform(0.2, 1),
                      size * random.uniform(0.2, 1),
                      size * random.uniformVector(0.2, 1),
                      {},
                      random.uniformVector(0.5, 1)};
  scene.at = scene.half.cwiseProduct(random.uniformVector(-1, 1));
  // Away along the normal of the slanted side, or along an axis.
  const double distance = random.uniform(0, 36);
  if (random.coin()) {
    const Vector3d normal = Vector3d(scene.height, scene.width, 0).normalized();
    const double part = random.uniform(0, 1);
    scene.at.head(2) =
        scene.half.head(2) + Eigen::Vector2d(part * scene.width, (1 - part) * scene.height);
    scene.at += distance * normal.cwiseProduct(scene.sigma).norm() * normal;
  } else {
    const int axis = random.integer(0, 2);
    scene.at[axis] = scene.half[axis] + Vector3d(scene.width, scene.height, scene.depth)[axis] +
                     distance * scene.sigma[axis];
  }
  return triangleCase(scene);
}

struct SphereScene {
  double radius_a, radius_b;
  Vector3d offset;
};

StabilityCase sphereCase(const SphereScene& scene, const GaussianDisplacement& displacement) {
  StabilityCase result;
  result.a = std::make_shared<fcl::Sphered>(scene.radius_a);
  result.b = std::make_shared<fcl::Sphered>(scene.radius_b);
  result.pose_b.translation() = scene.offset;
  result.displacement = {{1.0, displacement}};
  return result;
}

/// Of any size in units of the deviation, and up to 36 deviations away.
StabilityCase isotropicSpheres(StabilityRandom& random) {
  const double sigma = random.logUniform(1e-3, 1e3);
  const double size = sigma * random.logUniform(1e-3, 1e3);
  SphereScene scene{size * random.uniform(0.2, 1), size * random.uniform(0.2, 1), Vector3d::Zero()};
  const double radius = scene.radius_a + scene.radius_b;
  const double distance = std::max(0.0, radius + random.uniform(-3, 36) * sigma);
  scene.offset = distance * (random.rotation() * Vector3d::UnitX());
  StabilityCase result =
      sphereCase(scene, GaussianDisplacement::fromStandardDeviations(Vector3d::Constant(sigma)));
  Precise square = 0;
  for (const double x : scene.offset) square += Precise(x) * x;
  result.truth.lower =
      preciseBallMass(sqrt(square) / sigma, (Precise(scene.radius_a) + scene.radius_b) / sigma);
  result.truth.upper = result.truth.lower;
  return result;
}

/// Spheres that move along x only.
StabilityCase spheresOnALine(StabilityRandom& random) {
  const SphereScene scene{random.uniform(0.2, 1), random.uniform(0.2, 1),
                          random.uniformVector(-1, 1)};
  const double sigma = random.logUniform(0.05, 1);
  StabilityCase result =
      sphereCase(scene, GaussianDisplacement::fromStandardDeviations({sigma, 0, 0}));
  const Precise radius = Precise(scene.radius_a) + scene.radius_b;
  const Precise y = scene.offset.y(), z = scene.offset.z(), x = scene.offset.x();
  const Precise square = radius * radius - y * y - z * z;
  if (square >= 0) {
    const Precise reach = sqrt(square);
    result.truth.lower = AxisRange{x - reach, x + reach, sigma}.mass();
  }
  result.truth.upper = result.truth.lower;
  return result;
}

/// A box over a half-space of any direction, scale, and up to 36 deviations away.
StabilityCase halfspaceCase(StabilityRandom& random) {
  const double size = random.logUniform(1e-9, 1e9);
  const Vector3d half = size * random.uniformVector(0.2, 1);
  const Vector3d sigma = size * random.uniformVector(0.05, 0.5);
  const Vector3d normal = random.rotation() * Vector3d::UnitX();
  const double reach = normal.cwiseAbs().dot(half);
  const double deviation = normal.cwiseProduct(sigma).norm();
  const auto plane =
      std::make_shared<fcl::Halfspaced>(normal, -reach + random.uniform(-36, 8) * deviation);
  StabilityCase result;
  result.a = std::make_shared<fcl::Boxd>(Vector3d(2 * half));
  result.b = plane;
  result.displacement = {{1.0, GaussianDisplacement::fromStandardDeviations(sigma)}};
  Precise lowest = plane->d, variance = 0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    lowest += abs(Precise(plane->n[k])) * half[k];
    variance += Precise(plane->n[k]) * plane->n[k] * sigma[k] * sigma[k];
  }
  result.truth.lower = preciseNormalMass(lowest / sqrt(variance));
  result.truth.upper = result.truth.lower;
  return result;
}

/// Nearly all weight where no contact is possible; what is left is that of the others.
StabilityCase mixtureCase(StabilityRandom& random) {
  BoxScene scene;
  scene.half_a = random.uniformVector(0.2, 1);
  scene.half_b = random.uniformVector(0.2, 1);
  scene.at_a = random.uniformVector(-1, 1);
  scene.at_b = scene.at_a + (scene.half_a + scene.half_b).cwiseProduct(random.uniformVector(-1, 1));
  scene.sigma = random.uniformVector(0.05, 0.5);
  StabilityCase result = boxCase(scene, random.coin() ? BoxForm::shapes : BoxForm::solids, random);
  const double tiny[] = {random.logUniform(1e-200, 1e-3), random.logUniform(1e-16, 1e-3)};
  Precise sum = 0, mass = 0;
  const auto add = [&](double weight) {
    result.displacement.push_back({weight, scene.displacement()});
    sum += weight;
    mass += weight * scene.truth(true).lower;
  };
  result.displacement.clear();
  for (const double weight : tiny) {
    scene.mean = random.uniformVector(-0.3, 0.3);
    add(weight);
  }
  scene.mean = Vector3d(1e3, 0, 0);
  add(1 - tiny[0] - tiny[1]);
  result.truth.lower = result.truth.upper = mass / sum;
  return result;
}

}  // namespace

std::vector<StabilityFamily> otherStabilityFamilies() {
  const std::vector<Method> partition{Method::interval, Method::estimate};
  const std::vector<Method> convex{Method::exact, Method::interval, Method::estimate,
                                   Method::convex_pcd};
  const std::vector<Method> meshes{Method::interval, Method::estimate, Method::convex_pcd,
                                   Method::general_pcd};
  const std::string rare = "P down to 1e-280, sizes 1e-3σ to 1e3σ";
  std::vector<StabilityFamily> families;
  families.push_back({"meshes of one triangle", "triangle and box", meshes, kAbsoluteTolerance,
                      meshOfOneTriangle});
  families.push_back({rare, "prism and box", convex, kTinyTolerance, prismAndBox});
  families.push_back({rare, "spheres", convex, kTinyTolerance, isotropicSpheres});
  families.push_back({"Σ of rank 1",
                      "spheres",
                      {Method::interval, Method::estimate, Method::convex_pcd},
                      kAbsoluteTolerance,
                      spheresOnALine});
  families.push_back({"P down to 1e-280, lengths 1e-9 to 1e9 m",
                      "box and half-space",
                      {Method::exact, Method::interval},
                      kTinyTolerance,
                      halfspaceCase});
  families.push_back({"mixtures with weights down to 1e-200", "boxes or solids", partition,
                      kTinyTolerance, mixtureCase});
  return families;
}

}  // namespace fcl_prob::cli
