// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <Eigen/Geometry>

#include "base/constants.h"
#include "catch.h"
#include "fcl_prob/normal_mass.h"
#include "fcl_prob/polytope_mass.h"
#include "mass/polytope_clip.h"
#include "random_inputs.h"
#include "test_polytopes.h"

namespace fcl_prob {
namespace {

using detail::kEpsilon;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using fcl_prob_test::boxPolytope;
using fcl_prob_test::logUniform;
using fcl_prob_test::randomRotation;
using fcl_prob_test::randomVector;
using fcl_prob_test::uniform;

Vector3d boxMoment(const Vector3d& lo, const Vector3d& hi) {
  Vector3d moment;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    moment[k] = normalIntervalMoment(lo[k], hi[k]) * normalIntervalMass(lo[i], hi[i]) *
                normalIntervalMass(lo[j], hi[j]);
  }
  return moment;
}

bool holds(const VectorBounds& bounds, const Vector3d& truth) {
  const double slack = 1e-13 * truth.norm();
  return (bounds.lower.array() <= truth.array() + slack).all() &&
         (bounds.upper.array() >= truth.array() - slack).all();
}

ConvexPolytope movedBy(const ConvexPolytope& polytope, const Vector3d& shift) {
  ConvexPolytope moved = polytope;
  for (Vector3d& v : moved.vertices) v += shift;
  for (auto& face : moved.faces) face.offset += face.normal.dot(shift);
  return moved;
}

}  // namespace

TEST_CASE("moment of boxes from near the origin into the tails") {
  std::mt19937 random(1);
  double worst_error = 0, worst_width = 0;
  int tails = 0;
  for (int i = 0; i < 1500; ++i) {
    const double size = logUniform(random, 1e-1, 1e2);
    const Vector3d half =
        size * Vector3d(uniform(random, 0.1, 1), uniform(random, 0.1, 1), uniform(random, 0.1, 1));
    Vector3d lo, hi;
    for (int k = 0; k < 3; ++k) {
      lo[k] = random() % 2 == 0 ? uniform(random, -half[k], 0) : uniform(random, 0, 18);
      hi[k] = lo[k] + half[k];
    }
    const Matrix3d rotation = i % 3 == 0 ? Matrix3d::Identity() : randomRotation(random);
    const Vector3d truth = rotation * boxMoment(lo, hi);
    if (truth.norm() < 1e-280) continue;
    const ConvexPolytope polytope = boxPolytope(lo, hi, rotation);
    const VectorBounds bounds =
        polytopeMoment(polytope, 2 * kEpsilon * fcl_prob_test::reach(polytope));
    REQUIRE(holds(bounds, truth));
    worst_error = std::max(worst_error, (bounds.middle() - truth).norm() / truth.norm());
    worst_width = std::max(worst_width, (bounds.upper - bounds.lower).norm() / truth.norm());
    tails += truth.norm() < 1e-30;
  }
  CAPTURE(worst_error, worst_width);
  CHECK(worst_error < 1e-10);
  CHECK(worst_width < 1e-6);
  CHECK(tails > 100);
}

TEST_CASE("moment of symmetric and of small bodies") {
  const VectorBounds none = polytopeMoment(boxPolytope(-Vector3d::Ones(), Vector3d::Ones()));
  CHECK(holds(none, Vector3d::Zero()));
  CHECK((none.upper - none.lower).norm() < 1e-13);
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const Vector3d centre = 4 * randomVector(random);
    const Vector3d half = Vector3d::Constant(1e-3);
    const Vector3d truth = boxMoment(centre - half, centre + half);
    const VectorBounds bounds = polytopeMoment(boxPolytope(centre - half, centre + half));
    CHECK(holds(bounds, truth));
    CHECK((bounds.middle() - truth).norm() < 1e-8 * truth.norm());
  }
}

TEST_CASE("minus the moment is the derivative of the mass with respect to the position") {
  std::mt19937 random(3);
  for (int i = 0; i < 60; ++i) {
    const double size = logUniform(random, 0.3, 3);
    ConvexPolytope body =
        boxPolytope(Vector3d::Constant(-size), Vector3d::Constant(size), randomRotation(random));
    for (int cut = 0; cut < 6; ++cut) {
      body = detail::clipped(body, {randomVector(random).normalized(), -0.9 * size});
    }
    body = movedBy(body, uniform(random, 0, 3) * randomVector(random));
    const Vector3d moment = polytopeMoment(body).middle();
    constexpr double kStep = 1e-4;
    for (int k = 0; k < 3; ++k) {
      const auto massAt = [&](double step) {
        return polytopeMass(movedBy(body, step * Vector3d::Unit(k))).middle();
      };
      const double slope = (massAt(kStep) - massAt(-kStep)) / (2 * kStep);
      CHECK(std::abs(slope + moment[k]) < 1e-5 * (moment.norm() + massAt(0)));
    }
  }
}

TEST_CASE("the moments of the parts add up") {
  std::mt19937 random(4);
  for (int i = 0; i < 100; ++i) {
    const Vector3d shift = uniform(random, 0, 3) * randomVector(random);
    const ConvexPolytope whole =
        movedBy(boxPolytope(-Vector3d::Ones(), Vector3d::Ones(), randomRotation(random)), shift);
    const Vector3d normal = randomVector(random).normalized();
    const double offset = normal.dot(shift) + uniform(random, -0.5, 0.5);
    const Vector3d sum = polytopeMoment(detail::clipped(whole, {normal, offset})).middle() +
                         polytopeMoment(detail::clipped(whole, {-normal, -offset})).middle();
    const Vector3d expected = polytopeMoment(whole).middle();
    CHECK((sum - expected).norm() < 1e-11 * expected.norm());
  }
}

TEST_CASE("moment of a polytope without volume") {
  ConvexPolytope flat;
  flat.vertices = {{1, 0, 0}, {1, 1, 0}, {1, 0, 1}};
  CHECK(polytopeMoment(flat).upper == Vector3d::Zero());
  CHECK(polytopeMoment(flat, 1e-3).upper.x() > 0);
}

}  // namespace fcl_prob
