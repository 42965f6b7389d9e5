// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/convex_body.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>

#include "catch.h"
#include "convex/convex_set.h"
#include "fcl_prob/exceptions.h"
#include "mesh_shapes.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using fcl_prob::ConvexBody;
using fcl_prob::detail::ConvexMesh;

/// max of direction·p over the shape, from its definition.
using Support = std::function<double(const Eigen::Vector3d&)>;

void checkShape(const fcl::CollisionGeometryd& shape, bool polytope, const Support& support) {
  RandomBodies random(31);
  const ConvexBody body(shape);
  CHECK(body.isPolytope() == polytope);
  const auto& set = body.set();
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d d = random.direction();
    const double expected = support(d);
    CHECK(d.dot(body.supportPoint(3.0 * d)) == Approx(expected).epsilon(1e-13));
    const double outer = d.dot(set.outerMesh().supportPoint(d));
    const double inner = d.dot(set.innerMesh().supportPoint(d));
    CHECK(outer >= expected * (1 - 1e-14));
    CHECK(inner <= expected * (1 + 1e-14));
    CHECK(outer <= 1.08 * expected);
    CHECK(inner >= 0.93 * expected);
  }
  CHECK(body.set().size() >= set.outerMesh().supportPoint(Eigen::Vector3d::UnitX()).norm());
}

TEST_CASE("FCL's convex shapes as convex bodies") {
  const auto flat = [](const Eigen::Vector3d& d) { return std::hypot(d.x(), d.y()); };
  checkShape(fcl::Boxd(1, 2, 3), true, [](const Eigen::Vector3d& d) {
    return d.cwiseAbs().dot(Eigen::Vector3d(0.5, 1, 1.5));
  });
  checkShape(fcl::Sphered(2), false, [](const Eigen::Vector3d&) { return 2.0; });
  checkShape(fcl::Ellipsoidd(1, 2, 3), false, [](const Eigen::Vector3d& d) {
    return d.cwiseProduct(Eigen::Vector3d(1, 2, 3)).norm();
  });
  checkShape(fcl::Capsuled(0.5, 2), false,
             [](const Eigen::Vector3d& d) { return std::abs(d.z()) + 0.5; });
  checkShape(fcl::Cylinderd(1, 3), false,
             [&](const Eigen::Vector3d& d) { return 1.5 * std::abs(d.z()) + flat(d); });
  checkShape(fcl::Coned(1, 3), false, [&](const Eigen::Vector3d& d) {
    return std::max(1.5 * d.z(), -1.5 * d.z() + flat(d));
  });
  const Eigen::Vector3d a(1, 0, 0);
  const Eigen::Vector3d b(0, 1, 0);
  const Eigen::Vector3d c(0, 0, 1);
  const ConvexBody triangle{fcl::TrianglePd(a, b, c)};
  CHECK(triangle.isPolytope());
  CHECK(triangle.supportPoint({0, 0, 1}) == c);
}

TEST_CASE("bounding volumes as convex bodies") {
  const auto model = makeModel<fcl::OBBRSSd>(bumpyMesh(1.0, 12, 16, 5));
  const auto& bv = model->getBV(0).bv;
  RandomBodies random(32);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d d = random.direction();
    const double of_contents = [&] {
      double largest = -10.0;
      for (int v = 0; v < model->num_vertices; ++v) {
        largest = std::max(largest, d.dot(model->vertices[v]));
      }
      return largest;
    }();
    for (const ConvexBody& body : {ConvexBody(bv), ConvexBody(bv.obb), ConvexBody(bv.rss)}) {
      CHECK(d.dot(body.supportPoint(d)) >= of_contents - 1e-14);
    }
  }
}

TEST_CASE("what is no bounded convex shape is refused") {
  CHECK_THROWS_AS(ConvexBody(fcl::Halfspaced(Eigen::Vector3d::UnitX(), 0)),
                  fcl_prob::UnsupportedGeometry);
  CHECK_THROWS_AS(ConvexBody(*makeModel<fcl::OBBd>(boxMesh({1, 1, 1}))),
                  fcl_prob::UnsupportedGeometry);
  CHECK_THROWS_AS(ConvexBody(fcl::Sphered(-1)), fcl_prob::InvalidGeometry);
  CHECK_THROWS_AS(ConvexBody(fcl::Sphered(1), 7), fcl_prob::InvalidRequest);
  CHECK_THROWS_AS(ConvexBody(std::vector<Eigen::Vector3d>{}), fcl_prob::InvalidGeometry);
}

}  // namespace
