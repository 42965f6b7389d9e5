// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <Eigen/Geometry>

#include "catch.h"
#include "convex/zonotope.h"
#include "face_geometry.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using fcl_prob::detail::FaceSet;
using fcl_prob::detail::Zonotope;

Zonotope boxZonotope(const Eigen::Matrix3d& axes, const Eigen::Vector3d& half_sides) {
  Zonotope box;
  for (int k = 0; k < 3; ++k) box.addGenerator(half_sides[k] * axes.col(k));
  return box;
}

Zonotope sumOf(const Zonotope& a, const Zonotope& b) {
  Zonotope sum = a;
  for (int i = 0; i < b.generatorCount(); ++i) sum.addGenerator(b.generator(i));
  return sum;
}

/// McMullen's formula: 8 Σ |det| over the triples of generators.
double volumeByDeterminants(const Zonotope& zonotope) {
  double volume = 0.0;
  const int n = zonotope.generatorCount();
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      for (int k = j + 1; k < n; ++k) {
        volume +=
            8.0 *
            std::abs(zonotope.generator(i).dot(zonotope.generator(j).cross(zonotope.generator(k))));
      }
    }
  }
  return volume;
}

void checkFaces(const Zonotope& zonotope, RandomBodies& random) {
  FaceSet faces;
  const std::optional<double> defect = zonotope.faces(faces);
  REQUIRE(defect.has_value());
  double size = 0.0;
  for (int i = 0; i < zonotope.generatorCount(); ++i) size += zonotope.generator(i).norm();
  CHECK(*defect <= 1e-10 * size);
  CHECK(faces.closed());
  CHECK(std::abs(volumeOf(faces) - volumeByDeterminants(zonotope)) <=
        (1e-13 * size + *defect) * size * size);
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3d direction = random.direction();
    CHECK(std::abs(supportOf(faces.vertices(), direction) - zonotope.support(direction)) <=
          1e-14 * size);
    CHECK(std::abs(direction.dot(zonotope.supportPoint(direction)) - zonotope.support(direction)) <=
          1e-14 * size);
  }
  std::vector<Eigen::Vector3d> vertices = faces.vertices();
  CHECK(excessOver(faces, vertices) <= 1e-12 * size + *defect);
}

TEST_CASE("two boxes in general position have 30 faces in 15 pairs of planes") {
  RandomBodies random(1);
  for (int i = 0; i < 500; ++i) {
    const Zonotope sum = sumOf(boxZonotope(random.rotation(), random.normalVector().cwiseAbs()),
                               boxZonotope(random.rotation(), random.normalVector().cwiseAbs()));
    REQUIRE(sum.generatorCount() == 6);
    FaceSet faces;
    REQUIRE(sum.faces(faces) == 0.0);
    CHECK(faces.faceCount() == 30);
    CHECK(faces.vertices().size() == 32);
    checkFaces(sum, random);
  }
}

TEST_CASE("two boxes with the same axes are one box") {
  RandomBodies random(2);
  const Eigen::Matrix3d axes = random.rotation();
  Eigen::Matrix3d permuted;
  permuted << -axes.col(2), axes.col(0), axes.col(1);
  const Zonotope sum = sumOf(boxZonotope(axes, {1, 2, 3}), boxZonotope(permuted, {4, 5, 6}));
  CHECK(sum.generatorCount() == 3);
  FaceSet faces;
  REQUIRE(sum.faces(faces));
  CHECK(faces.faceCount() == 6);
  CHECK(volumeOf(faces) == Approx(8.0 * 6 * 8 * 7));
}

TEST_CASE("coplanar generators, flat and needle-like boxes still give a closed surface") {
  RandomBodies random(3);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Matrix3d axes = random.rotation();
    const Eigen::Matrix3d turned =
        axes * Eigen::AngleAxisd(random.uniform(0, 7), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    Eigen::Vector3d sides_a = random.normalVector().cwiseAbs();
    Eigen::Vector3d sides_b = random.normalVector().cwiseAbs();
    if (i % 3 == 1) sides_a[random.integer(0, 2)] = 0.0;  // flat, as the OBB of one triangle
    if (i % 3 == 2) sides_b[random.integer(0, 2)] *= 1e-9;
    checkFaces(sumOf(boxZonotope(axes, sides_a), boxZonotope(turned, sides_b)), random);
    // Nearly the same axes: what two trees over the same mesh produce.
    const Eigen::Matrix3d nearly =
        axes *
        Eigen::AngleAxisd(random.logUniform(1e-16, 1e-3), random.direction()).toRotationMatrix();
    checkFaces(sumOf(boxZonotope(axes, sides_a), boxZonotope(nearly, sides_b)), random);
  }
}

TEST_CASE("a zonotope without volume has two sides or none") {
  Zonotope flat(Eigen::Vector3d(1, 2, 3));
  flat.addGenerator(Eigen::Vector3d(1, 0, 0));
  flat.addGenerator(Eigen::Vector3d(0, 2, 0));
  FaceSet faces;
  REQUIRE(flat.faces(faces));
  CHECK(faces.faceCount() == 2);
  CHECK(faces.vectorArea(0).norm() == Approx(8.0));
  CHECK((faces.vectorArea(0) + faces.vectorArea(1)).norm() <= 1e-15);

  Zonotope point;
  point.addGenerator(Eigen::Vector3d::Zero());
  CHECK(point.generatorCount() == 0);
  REQUIRE(point.faces(faces));
  CHECK(faces.faceCount() == 0);
}

}  // namespace
