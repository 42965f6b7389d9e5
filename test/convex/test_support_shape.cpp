// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Support functions against the definitions of the shapes.
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "catch.h"
#include "convex/support_obstacle.h"
#include "convex/support_shape.h"
#include "fcl_prob/exceptions.h"
#include "random_bodies.h"
#include "shapes.h"

using fcl_prob::detail::SupportObstacle;
using fcl_prob::detail::SupportShape;
using fcl_prob::detail::supportShape;
using namespace fcl_prob_test;

namespace {

// How far outside of the shape a point is, relative to the shape's own measure: <= 0 inside.
using Excess = std::function<double(const Eigen::Vector3d&)>;

struct Defined {
  std::shared_ptr<fcl::CollisionGeometryd> geometry;
  Excess excess;
};

double across(const Eigen::Vector3d& p) { return p.head<2>().norm(); }

std::vector<Defined> definedShapes() {
  return {
      {std::make_shared<fcl::Sphered>(0.5),
       [](const Eigen::Vector3d& p) { return p.norm() / 0.5 - 1; }},
      {std::make_shared<fcl::Ellipsoidd>(0.3, 0.5, 0.7),
       [](const Eigen::Vector3d& p) {
         return p.cwiseQuotient(Eigen::Vector3d(0.3, 0.5, 0.7)).norm() - 1;
       }},
      {std::make_shared<fcl::Capsuled>(0.25, 0.8),
       [](const Eigen::Vector3d& p) {
         const Eigen::Vector3d on_axis(0, 0, std::clamp(p.z(), -0.4, 0.4));
         return (p - on_axis).norm() / 0.25 - 1;
       }},
      {std::make_shared<fcl::Cylinderd>(0.3, 0.8),
       [](const Eigen::Vector3d& p) {
         return std::max(across(p) / 0.3, std::fabs(p.z()) / 0.4) - 1;
       }},
      {std::make_shared<fcl::Coned>(0.4, 0.9),
       [](const Eigen::Vector3d& p) {
         const double radius = 0.4 * (0.45 - p.z()) / 0.9;
         return std::max((across(p) - radius) / 0.4, std::fabs(p.z()) / 0.45 - 1);
       }},
  };
}

}  // namespace

TEST_CASE("support points are points of the shape, and none of it lies farther") {
  RandomBodies random(1);
  for (const Defined& defined : definedShapes()) {
    const SupportShape shape = supportShape(*defined.geometry);
    std::vector<Eigen::Vector3d> inside;
    int tried = 0;
    while (inside.size() < 20000 && ++tried < 10000000) {
      const double x = random.uniform(-1.0, 1.0), y = random.uniform(-1.0, 1.0),
                   z = random.uniform(-1.0, 1.0);
      const Eigen::Vector3d p(x, y, z);
      if (defined.excess(p) <= 0) inside.push_back(p);
    }
    REQUIRE(inside.size() == 20000);
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d direction = random.direction();
      const Eigen::Vector3d point = shape.supportPoint(direction);
      const double value = shape.supportValue(direction);
      CHECK(std::fabs(defined.excess(point)) < 1e-12);
      CHECK(direction.dot(point) == Approx(value).epsilon(1e-13));
      double farthest = -1.0;
      for (const Eigen::Vector3d& p : inside) farthest = std::max(farthest, direction.dot(p));
      CHECK(farthest <= value + 1e-12);
      CHECK(farthest > value - 0.15);
    }
  }
}

TEST_CASE("support points across the axis of a disk and along the axis") {
  for (const Defined& defined : definedShapes()) {
    const SupportShape shape = supportShape(*defined.geometry);
    for (const double sign : {-1.0, 1.0}) {
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d direction = sign * Eigen::Vector3d::Unit(k);
        CHECK(std::fabs(defined.excess(shape.supportPoint(direction))) < 1e-12);
      }
    }
    CHECK(defined.excess(shape.centre()) < 0);
  }
}

TEST_CASE("the derivative of the support point is that of its difference quotients") {
  RandomBodies random(2);
  int smooth = 0;
  for (const Defined& defined : definedShapes()) {
    const SupportShape shape = supportShape(*defined.geometry);
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector3d direction = random.direction();
      const Eigen::Vector3d step = 1e-6 * random.direction();
      const Eigen::Vector3d change =
          shape.supportPoint(direction + step) - shape.supportPoint(direction - step);
      const Eigen::Vector3d expected = 2 * shape.supportDerivative(direction) * step;
      CHECK((change - expected).norm() < 1e-4 * step.norm());
      smooth += expected.norm() > 0.01 * step.norm();
    }
  }
  CHECK(smooth > 150);
}

TEST_CASE("an image under a linear map has the support function of the image") {
  RandomBodies random(3);
  for (const NamedGeometry& named : boundedShapes()) {
    INFO(named.name);
    const SupportShape shape = supportShape(*named.geometry);
    const Eigen::Matrix3d linear = random.rotation() * Eigen::Vector3d(0.1, 2, 30).asDiagonal();
    const SupportShape image = shape.transformed(linear);
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector3d direction = random.direction();
      CHECK(image.supportValue(direction) ==
            Approx(shape.supportValue(linear.transpose() * direction)).epsilon(1e-12));
    }
  }
}

TEST_CASE("the C-obstacle of two bodies contains differences of their points only") {
  RandomBodies random(4);
  const auto shapes = boundedShapes();
  for (const NamedGeometry& a : shapes) {
    for (const NamedGeometry& b : shapes) {
      const SupportShape shape_a = supportShape(*a.geometry), shape_b = supportShape(*b.geometry);
      const Eigen::Vector3d at_a = random.direction(), at_b = random.direction();
      const SupportObstacle obstacle({shape_a, at_a}, {shape_b, at_b}, Eigen::Vector3d::Zero());
      for (int i = 0; i < 5; ++i) {
        const Eigen::Vector3d direction = random.direction();
        const Eigen::Vector3d expected =
            shape_b.supportPoint(direction) + at_b - shape_a.supportPoint(-direction) - at_a;
        CHECK((obstacle.supportPoint(direction) - expected).norm() < 1e-14);
        CHECK(obstacle.supportUpper(direction) == Approx(direction.dot(expected)).epsilon(1e-12));
        CHECK(direction.dot(obstacle.centre()) <= obstacle.supportUpper(direction));
      }
    }
  }
}

TEST_CASE("unbounded shapes have no support function") {
  CHECK_THROWS_AS(supportShape(fcl::Halfspaced(0, 0, 1, 0)), fcl_prob::UnsupportedGeometry);
}

TEST_CASE("a direction that has overflowed has a point of the shape and no height", "[cobstacle]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const SupportShape shape = supportShape(fcl::Cylinderd(0.5, 1.0));
  CHECK(std::abs(shape.supportPoint({nan, nan, nan}).z()) == 0.5);
  CHECK(std::isnan(shape.supportValue({nan, nan, nan})));
}
