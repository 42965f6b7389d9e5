// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bounds/relaxed_integral.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "catch.h"
#include "convex/minkowski_sum.h"
#include "face_geometry.h"
#include "fcl_prob/normal_mass.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob::detail;
using fcl_prob::GaussianDisplacement;

const Eigen::Matrix3d kNoError = Eigen::Matrix3d::Zero();

/// ∫ φ(t)/(2π) A(t) dt over the sections' areas A(t), which is the relaxed integral by Fubini; A is
/// a quadratic between the heights of the vertices.
double integralOverSections(const FaceSet& faces, const Eigen::Vector3d& n) {
  using Gauss = boost::math::quadrature::gauss<double, 30>;
  std::vector<double> heights;
  for (const Eigen::Vector3d& v : faces.vertices()) heights.push_back(n.dot(v));
  std::sort(heights.begin(), heights.end());
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
    const int panels = static_cast<int>(std::ceil((heights[i + 1] - heights[i]) / 0.5));
    for (int k = 0; k < panels; ++k) {
      const double step = (heights[i + 1] - heights[i]) / panels;
      const double from = heights[i] + k * step;
      sum += Gauss::integrate(
          [&](double t) {
            return std::exp(-0.5 * t * t) / std::pow(2.0 * M_PI, 1.5) * sectionArea(faces, n, t);
          },
          from, from + step);
    }
  }
  return sum;
}

FaceSet randomBody(RandomBodies& random, double size, const Eigen::Vector3d& centre) {
  MinkowskiSum sum;
  FaceSet faces;
  REQUIRE(sum.compute(makeConvexMesh(random.cloud(random.integer(4, 10), size)),
                      makeConvexMesh(random.cloud(random.integer(3, 10), size)), faces));
  for (Eigen::Vector3d& v : faces.vertices()) v += centre;
  return faces;
}

// This is the test that a field twice too large, as the paper prints it, cannot pass; nor one half
// as large.
TEST_CASE("the face sum is the integral of the relaxed density, to the constant") {
  RandomBodies random(61);
  std::vector<TailValue> work;
  int deep = 0;
  int narrow = 0;
  for (int i = 0; i < 250; ++i) {
    const double size = random.logUniform(1e-2, 30.0);
    const Eigen::Vector3d direction = random.direction();
    const FaceSet faces = randomBody(random, size, (size + random.uniform(0.0, 8.0)) * direction);
    const Eigen::Vector3d n = (direction + 0.2 * random.normalVector()).normalized();
    const double expected = integralOverSections(faces, n);
    const RelaxedIntegral found = relaxedIntegral(faces, kNoError, n, work);
    INFO("size " << size << " expected " << expected << " found " << found.value);
    CHECK(found.value == Approx(expected).epsilon(1e-7).margin(1e-290));
    CHECK(std::abs(found.value - expected) <= found.margin + 1e-7 * expected);
    deep += expected < 1e-8;
    narrow += size < 0.1;
  }
  CHECK(deep > 20);
  CHECK(narrow > 20);
}

TEST_CASE("a box seen face-on: the cross-section times a normal mass") {
  FaceSet faces;
  std::vector<TailValue> work;
  for (const double side : {1e-4, 0.01, 1.0, 100.0}) {
    for (const double distance : {0.0, 1.0, 8.0}) {
      setToBox(Eigen::Vector3d(distance, -0.5 * side, -side),
               Eigen::Vector3d(distance + side, 0.5 * side, side), faces);
      const double expected = 2.0 * side * side / (2.0 * M_PI) *
                              fcl_prob::normalIntervalMass(distance, distance + side);
      const RelaxedIntegral found =
          relaxedIntegral(faces, kNoError, Eigen::Vector3d::UnitX(), work);
      CHECK(found.value == Approx(expected).epsilon(1e-9));
      CHECK(found.upper() >= expected);
      CHECK(found.upper() <= (1 + 1e-5) * expected);
    }
  }
}

TEST_CASE("the integral does not depend on the side from which it is seen") {
  RandomBodies random(62);
  std::vector<TailValue> work;
  for (int i = 0; i < 50; ++i) {
    const FaceSet faces = randomBody(random, random.logUniform(0.1, 10), random.normalVector());
    const Eigen::Vector3d n = random.direction();
    CHECK(relaxedIntegral(faces, kNoError, n, work).value ==
          Approx(relaxedIntegral(faces, kNoError, -n, work).value).epsilon(1e-9));
  }
}

TEST_CASE("an ellipsoid's sections against those of a fine polytope") {
  RandomBodies random(64);
  std::vector<TailValue> work;
  for (int i = 0; i < 20; ++i) {
    const auto displacement = GaussianDisplacement::fromStandardDeviations(
        {random.logUniform(0.3, 3), random.logUniform(0.3, 3), random.logUniform(0.3, 3)},
        random.quaternion());
    const double radius = random.logUniform(0.03, 3);
    Eigen::Isometry3d pose_b = Eigen::Isometry3d::Identity();
    pose_b.translation() = random.uniform(0.0, 5.0) * random.direction();
    const PairFrame frame(displacement, Eigen::Isometry3d::Identity(), 1.0, pose_b, 1.0);
    const Ellipsoid ball{frame.offset, radius};
    const Eigen::Vector3d n = (frame.whitening * ball.centre).normalized();
    const ConvexSet fine({{frame.offset}, 1, radius * Eigen::Matrix3d::Identity()}, 600);
    double bound[2];
    for (int outer = 0; outer < 2; ++outer) {
      FaceSet faces;
      MinkowskiSum sum;
      REQUIRE(sum.compute(outer ? fine.outerMesh() : fine.innerMesh(),
                          makeConvexMesh({Eigen::Vector3d::Zero()}), faces));
      for (Eigen::Vector3d& v : faces.vertices()) v = frame.whitening * v;
      bound[outer] = relaxedIntegral(faces, kNoError, n, work).value;
    }
    const double found = relaxedIntegral(ball, frame, n).value;
    CHECK(found >= bound[0]);
    CHECK(found <= bound[1]);
    CHECK(bound[1] <= 1.2 * bound[0]);
  }
}

TEST_CASE("what may reach out of the faces is added") {
  FaceSet flat;
  flat.addVertex({2, 0, 0});
  flat.addVertex({2, 1, 0});
  flat.addVertex({2, 0, 1});
  flat.addFace({0, 1, 2});
  flat.addFace({0, 2, 1});
  std::vector<TailValue> work;
  const double error = 1e-6;
  const double upper =
      relaxedIntegral(flat, error * Eigen::Matrix3d::Identity(), Eigen::Vector3d::UnitX(), work)
          .upper();
  const double area = 0.5;
  const double density = std::exp(-2.0) / std::pow(2.0 * M_PI, 1.5);
  CHECK(upper >= 2.0 * error * area * density);
  CHECK(upper <= 4.0 * error * area * density);
}

}  // namespace
