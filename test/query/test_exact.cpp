// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Pairs of convex shapes: exact, and what the automatic method makes of them.
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "catch.h"
#include "exact_cases.h"
#include "fcl_prob/fcl_prob.h"
#include "fcl_prob/monte_carlo.h"
#include "fcl_prob/normal_mass.h"
#include "mesh_shapes.h"
#include "random_bodies.h"

using namespace fcl_prob;
using namespace fcl_prob_test;
using Catch::Matchers::Contains;

TEST_CASE("two boxes are answered exactly, from certain to 1e-200") {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.8, Eigen::Vector3d(2, -1, 1).normalized()));
  const fcl::Transform3d world(turn);
  std::mt19937_64 generator(31);
  std::uniform_real_distribution<double> side(0.2, 1.5), offset(-1.5, 1.5), exponent(-1.5, 0.3);
  int likely = 0;
  int rare = 0;
  for (int i = 0; i < 300; ++i) {
    const auto three = [&](auto& distribution) {
      return Eigen::Vector3d(distribution(generator), distribution(generator),
                             distribution(generator));
    };
    const Eigen::Vector3d sides_a = three(side), sides_b = three(side), move = three(offset);
    Eigen::Vector3d sigma;
    for (double& s : sigma) s = std::pow(10.0, exponent(generator));
    const Eigen::Vector3d half = 0.5 * (sides_a + sides_b);
    const double expected =
        normalBoxMass((move - half).cwiseQuotient(sigma), (move + half).cwiseQuotient(sigma));
    if (expected < 1e-200) continue;
    likely += expected > 0.1;
    rare += expected < 1e-6;
    const ProbabilityResult result =
        answer(fcl::Boxd(sides_a), world, fcl::Boxd(sides_b), world * at(move),
               GaussianDisplacement::fromStandardDeviations(sigma, turn));
    REQUIRE(result.method == ProbabilityMethod::exact);
    REQUIRE(result.status == ProbabilityStatus::exact);
    REQUIRE(*result.lower <= expected * (1 + 1e-12));
    REQUIRE(*result.upper >= expected * (1 - 1e-12));
    REQUIRE(result.probability() == Approx(expected).epsilon(1e-9));
  }
  CHECK(likely > 20);
  CHECK(rare > 30);
}

TEST_CASE("the plan says that no tree was needed") {
  const fcl::Boxd box(1, 1, 1);
  const auto isotropic = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  const auto result = answer(box, kIdentity, box, at({1.2, 0, 0}), isotropic);
  CHECK(planMentions(result, "no tree"));
  CHECK(planMentions(result, "isotropic"));
  const auto stretched = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.2});
  CHECK_FALSE(planMentions(answer(box, kIdentity, box, at({1.2, 0, 0}), stretched), "isotropic"));
}

TEST_CASE("two polytopes have their gradient in closed form") {
  const fcl::Boxd box(1, 1, 1);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  ProbabilityRequest request;
  request.gradient = true;
  const auto result = answer(box, kIdentity, box, at({1.1, 0, 0}), displacement, request);
  CHECK(result.method == ProbabilityMethod::exact);
  REQUIRE(result.gradient);
  const double slope = 0.39894228040143268 * std::exp(-0.5) / 0.1;
  CHECK((*result.gradient)[0] == Approx(slope).epsilon(1e-10));
}

TEST_CASE("two spheres agree with the closed form of a ball") {
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  const auto result =
      answer(fcl::Sphered(0.3), kIdentity, fcl::Sphered(0.2), at({0.9, 0, 0}), displacement);
  // Φ(-4) - Φ(-14) - (φ(4) - φ(14)) / 9: a ball of radius 5 in a distance of 9.
  const double ball = normalTailMass(4) - normalTailMass(14) -
                      0.39894228040143268 * (std::exp(-8.0) - std::exp(-98.0)) / 9;
  CHECK(result.probability() == Approx(ball).epsilon(1e-9));
  CHECK(result.status == ProbabilityStatus::exact);
}

TEST_CASE("two spheres under any covariance are exact") {
  const fcl::Sphered a(0.3), b(0.2);
  const auto axes = Eigen::Quaterniond(1, 0.3, 0.2, 0.5).normalized();
  // A disc of five deviations about the mean.
  const auto disc = answer(a, kIdentity, b, at({0, 0, 0}),
                           GaussianDisplacement::fromStandardDeviations({0.5, 0.5, 0}, axes));
  CHECK(disc.probability() == Approx(-std::expm1(-0.5)).epsilon(1e-10));
  for (const Eigen::Vector3d& sigma :
       {Eigen::Vector3d(0.3, 0.1, 0.2), Eigen::Vector3d(0.3, 0.1, 0), Eigen::Vector3d(0.3, 0, 0)}) {
    const auto displacement = GaussianDisplacement::fromStandardDeviations(sigma, axes);
    const Eigen::Vector3d gap = displacement.axes() * Eigen::Vector3d(0.6, 0.1, 0.1);
    const auto result = answer(a, kIdentity, b, at(gap), displacement);
    CHECK(result.method == ProbabilityMethod::exact);
    CHECK(result.status == ProbabilityStatus::exact);
    CHECK(*result.upper - *result.lower <= 1e-10 * *result.upper);
    CHECK(std::find(result.plan.begin(), result.plan.end(),
                    "two spheres: their C-obstacle is a ball, mass by quadrature") !=
          result.plan.end());
    ProbabilityRequest request;
    request.method = ProbabilityMethod::interval;
    request.relative_tolerance = 0.003;
    const auto interval = answer(a, kIdentity, b, at(gap), displacement, request);
    CHECK(*interval.lower <= *result.upper);
    CHECK(*interval.upper >= *result.lower);
  }
}

TEST_CASE("curved shapes go to quadrature, which reaches the tolerance") {
  const fcl::Sphered sphere(0.4);
  const fcl::Ellipsoidd ellipsoid(0.5, 0.3, 0.4);
  const fcl::Capsuled capsule(0.3, 0.6);
  const fcl::Cylinderd cylinder(0.4, 0.7);
  const fcl::Coned cone(0.5, 0.8);
  const fcl::Boxd box(0.6, 0.7, 0.8);
  const std::vector<const fcl::CollisionGeometryd*> shapes = {&sphere,   &ellipsoid, &capsule,
                                                              &cylinder, &cone,      &box};
  const auto displacement = GaussianDisplacement::fromStandardDeviations(
      {0.3, 0.1, 0.2}, Eigen::Quaterniond(1, 0.3, 0.2, 0.5).normalized());
  const fcl::Transform3d pose_b =
      at({0.9, 0.4, 0.3}) * Eigen::Quaterniond(1, 0.2, 0.7, 0.1).normalized();
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const fcl::CollisionGeometryd& a = *shapes[i];
    const fcl::CollisionGeometryd& b = *shapes[(i + 2) % shapes.size()];
    INFO("shapes " << i << " and " << (i + 2) % shapes.size());
    const auto result = answer(a, kIdentity, b, pose_b, displacement);
    // A sphere and a capsule, a box and an ellipsoid: swept polytopes.
    const bool swept = i == 0 || i == 5;
    CHECK(result.method == ProbabilityMethod::exact);
    CHECK(result.status == (swept ? ProbabilityStatus::exact : ProbabilityStatus::converged));
    CHECK(*result.upper - *result.lower <= (swept ? 1e-9 : 1e-6) * *result.upper);

    ProbabilityRequest request;
    request.samples = 20000;
    request.seed = 2;
    const auto sampled = monteCarloProbability(a, kIdentity, b, pose_b, displacement, request);
    CHECK(*sampled.estimate > 0.02);
    CHECK(*sampled.estimate < 0.98);
    CHECK(*sampled.estimate >= *result.lower - 4 * *sampled.standard_error);
    CHECK(*sampled.estimate <= *result.upper + 4 * *sampled.standard_error);
  }
}

TEST_CASE("rounded pairs are exact, with their gradient") {
  const fcl::Sphered sphere(0.3);
  const fcl::Capsuled capsule(0.2, 0.6);
  const fcl::Boxd box(0.5, 0.4, 0.3);
  const std::vector<std::pair<const fcl::CollisionGeometryd*, const fcl::CollisionGeometryd*>>
      pairs = {{&sphere, &sphere}, {&sphere, &capsule}, {&box, &sphere}, {&capsule, &box}};
  const auto axes = Eigen::Quaterniond(1, 0.3, 0.2, 0.5).normalized();
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.3, 0.1, 0.2}, axes);
  const fcl::Transform3d pose_b =
      at({0.6, 0.4, 0.3}) * Eigen::Quaterniond(1, 0.2, 0.7, 0.1).normalized();
  for (const auto& pair : pairs) {
    // Named one by one: a lambda of C++17 cannot capture what a structured binding names.
    const fcl::CollisionGeometryd& a = *pair.first;
    const fcl::CollisionGeometryd& b = *pair.second;
    ProbabilityRequest request;
    request.gradient = true;
    const auto result = answer(a, kIdentity, b, pose_b, displacement, request);
    CHECK(result.method == ProbabilityMethod::exact);
    CHECK(result.status == ProbabilityStatus::exact);
    CHECK(*result.upper - *result.lower <= 1e-9 * *result.upper);
    REQUIRE(result.gradient);
    CHECK((*result.gradient_upper - *result.gradient_lower).maxCoeff() <= 1e-6);
    for (int k = 0; k < 3; ++k) {
      constexpr double kStep = 1e-3;
      const auto moved = [&](double step) {
        return answer(a, kIdentity, b, pose_b,
                      displacement.withMean(step * Eigen::Vector3d::Unit(k)))
            .probability();
      };
      const double slope =
          (8 * (moved(kStep) - moved(-kStep)) - (moved(2 * kStep) - moved(-2 * kStep))) /
          (12 * kStep);
      CHECK((*result.gradient)[k] == Approx(slope).epsilon(1e-6).margin(1e-7));
    }
    request.method = ProbabilityMethod::interval;
    const auto interval = answer(a, kIdentity, b, pose_b, displacement, request);
    CHECK(*result.lower <= *interval.upper);
    CHECK(*result.upper >= *interval.lower);
    REQUIRE(interval.gradient_lower);
    CHECK((*result.gradient_lower - *interval.gradient_upper).maxCoeff() <= 0.0);
    CHECK((*interval.gradient_lower - *result.gradient_upper).maxCoeff() <= 0.0);
  }
}

TEST_CASE("the exact method integrates over the boundaries of curved shapes") {
  const fcl::Cylinderd cylinder(0.3, 0.5);
  const fcl::Ellipsoidd ellipsoid(0.3, 0.2, 0.4);
  const fcl::Boxd box(0.5, 0.4, 0.3);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.05});
  ProbabilityRequest request;
  request.relative_tolerance = 1e-6;
  const auto with_box =
      answer(cylinder, kIdentity, box, at({0.8, 0.2, 0.1}), displacement, request);
  CHECK(with_box.method == ProbabilityMethod::exact);
  CHECK(with_box.status == ProbabilityStatus::converged);
  CHECK(planMentions(with_box, "quadrature over its boundary"));
  CHECK_FALSE(planMentions(with_box, "enclosed"));
  const auto with_ellipsoid =
      answer(ellipsoid, kIdentity, cylinder, at({0.8, 0.2, 0.1}), displacement, request);
  CHECK(with_ellipsoid.method == ProbabilityMethod::exact);
  CHECK(*with_ellipsoid.upper - *with_ellipsoid.lower <= 1e-6 * *with_ellipsoid.upper);
  request.method = ProbabilityMethod::interval;
  request.relative_tolerance = 1e-3;
  const auto interval =
      answer(cylinder, kIdentity, box, at({0.8, 0.2, 0.1}), displacement, request);
  CHECK(*with_box.lower <= *interval.upper);
  CHECK(*with_box.upper >= *interval.lower);
  request.method = ProbabilityMethod::automatic;
  request.gradient = true;
  const auto with_gradient =
      answer(cylinder, kIdentity, box, at({0.8, 0.2, 0.1}), displacement, request);
  CHECK(with_gradient.method == ProbabilityMethod::exact);
  CHECK(with_gradient.gradient);
}

TEST_CASE("what cells leave open of two convex shapes their exact mass closes") {
  const fcl::Sphered sphere(3.0), other(2.0);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.3, 0.3, 0.3});
  // Five deviations out.
  const Eigen::Vector3d place(4.0, 5.0, 1.2);
  const fcl::Transform3d pose = at(place);
  const double truth = fcl_prob::normalBallMass(place.norm() / 0.3, 5.0 / 0.3).lower;
  for (const auto method : {ProbabilityMethod::interval, ProbabilityMethod::estimate}) {
    ProbabilityRequest request;
    request.method = method;
    request.relative_tolerance = 1e-4;
    request.absolute_tolerance = 0.0;
    request.max_cells = 20;
    const auto result = answer(sphere, kIdentity, other, pose, displacement, request);
    CHECK(result.method == method);
    CHECK(result.status == ProbabilityStatus::exact);
    CHECK(planMentions(result, "the cells left too much open"));
    CHECK(result.probability() == Approx(truth).epsilon(1e-9));
    request.max_cells = 20'000;
    request.relative_tolerance = 0.1;
    CHECK_FALSE(planMentions(answer(sphere, kIdentity, other, pose, displacement, request),
                             "the cells left too much open"));
  }
}

TEST_CASE("asked for by name, the exact method has sections of curved shapes to six digits") {
  const fcl::Coned cone(0.3, 0.5), other(0.3, 0.4);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.0});
  ProbabilityRequest request;
  request.relative_tolerance = 1e-4;
  request.method = ProbabilityMethod::interval;
  const auto interval = answer(cone, kIdentity, other, at({0.7, 0.2, 0.1}), displacement, request);
  request.method = ProbabilityMethod::exact;
  const auto section = answer(cone, kIdentity, other, at({0.7, 0.2, 0.1}), displacement, request);
  CHECK(section.method == ProbabilityMethod::exact);
  CHECK(section.status == ProbabilityStatus::converged);
  CHECK(planMentions(section, "between two polygons"));
  CHECK(*section.lower <= *interval.upper);
  CHECK(*section.upper >= *interval.lower);
  CHECK(*section.upper - *section.lower <= 1e-6 * *section.upper);
}

// Their C-obstacle's facets are slivers where sides are parallel, with normals that are noise.
TEST_CASE("the exact method of round shapes with one axis, around the origin and not", "[slow]") {
  const fcl::Cylinderd cylinder(1.0, 1.3);
  ProbabilityRequest request;
  request.method = ProbabilityMethod::exact;
  request.relative_tolerance = 0.05;
  for (const double sigma : {1.0, 0.3, 0.1, 0.01}) {
    for (const double height : {0.0, 0.9, 1.28, 1.4}) {
      const auto displacement = GaussianDisplacement::fromStandardDeviations({sigma, sigma, sigma});
      const auto result =
          answer(cylinder, at({0.0, 0.0, height}), cylinder, kIdentity, displacement, request);
      // A cylinder of twice the size; the distance from its axis has Rayleigh's distribution.
      const double p = -std::expm1(-0.5 * (2.0 / sigma) * (2.0 / sigma)) *
                       normalIntervalMass((-1.3 - height) / sigma, (1.3 - height) / sigma);
      CAPTURE(sigma, height, p);
      CHECK(*result.lower <= p * (1.0 + 1e-12));
      CHECK(*result.upper >= p * (1.0 - 1e-12));
      CHECK(*result.upper - *result.lower < 0.02 * p);
    }
  }
  const fcl::Coned cone(1.0, 1.3);
  const fcl::Ellipsoidd ellipsoid(1.0, 1.3, 0.7);
  const std::vector<const fcl::ShapeBased*> shapes{&cone, &ellipsoid, &cylinder};
  for (const fcl::ShapeBased* a : shapes) {
    for (const fcl::ShapeBased* b : shapes) {
      for (const double sigma : {1.0, 0.2}) {
        const auto displacement =
            GaussianDisplacement::fromStandardDeviations({sigma, sigma, sigma});
        const auto enclosed = answer(*a, at({0.1, 0.1, 0.1}), *b, kIdentity, displacement, request);
        const auto interval = answer(*a, at({0.1, 0.1, 0.1}), *b, kIdentity, displacement);
        CHECK(*enclosed.lower <= *interval.upper);
        CHECK(*enclosed.upper >= *interval.lower);
        CHECK(*enclosed.upper - *enclosed.lower < 0.05);
      }
    }
  }
}

// Whitening stretches their C-obstacle a billion times.
TEST_CASE("the exact method of a displacement that hardly moves along one axis") {
  RandomBodies random(11);
  const fcl::Sphered sphere(1.7);
  const fcl::Cylinderd cylinder(0.8, 1.5);
  const fcl::Boxd box(7.2, 2.1, 7.7);
  ProbabilityRequest request;
  request.method = ProbabilityMethod::exact;
  request.relative_tolerance = 0.1;
  ProbabilityRequest few_cells;
  few_cells.method = ProbabilityMethod::interval;
  few_cells.max_cells = 40;
  int partly = 0;
  for (int i = 0; i < 24; ++i) {
    const fcl::ShapeBased& shape = i % 2 == 0 ? static_cast<const fcl::ShapeBased&>(sphere)
                                              : static_cast<const fcl::ShapeBased&>(cylinder);
    const fcl::Transform3d pose = random.pose(8.0);
    const auto displacement = GaussianDisplacement::fromStandardDeviations({5.0, 1.0, 1e-9});
    const auto exact = answer(shape, pose, box, at({0.1, 0.2, 0.3}), displacement, request);
    const auto interval = answer(shape, pose, box, at({0.1, 0.2, 0.3}), displacement, few_cells);
    CHECK(*exact.lower <= *interval.upper);
    CHECK(*exact.upper >= *interval.lower);
    partly += *interval.upper < 0.9;
  }
  CHECK(partly > 5);
}

// A needle of 140,000 standard deviations: what is far out must not be integrated to the last
// digit.
TEST_CASE("the exact method of a stretched round pair takes few evaluations") {
  const fcl::Sphered sphere(7.0);
  const fcl::Cylinderd cylinder(7.0, 14.0);
  ProbabilityRequest request;
  request.method = ProbabilityMethod::exact;
  request.absolute_tolerance = 0.0;
  request.relative_tolerance = 1e-6;
  int calls = 0;
  request.on_progress = [&](const ProbabilityProgress&) { return ++calls > 0; };
  const auto displacement = GaussianDisplacement::fromStandardDeviations({1e5, 7e4, 1e-4});
  const auto result =
      answer(sphere, kIdentity, cylinder, at({14.0, 7.0, 0.7}), displacement, request);
  CHECK(*result.upper - *result.lower < 0.02 * *result.upper);
  CHECK(*result.lower > 1.3e-8);
  CHECK(calls < 2500);
}

TEST_CASE("a matrix that is nearly a rotation is used as it is, whatever the shape is made of") {
  const fcl::Boxd box(2, 2, 2);
  const auto vertices = std::make_shared<std::vector<Eigen::Vector3d>>();
  for (int i = 0; i < 8; ++i) {
    vertices->push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  }
  const fcl::Convexd cube(vertices, 6,
                          std::make_shared<std::vector<int>>(
                              std::vector<int>{4, 0, 4, 6, 2, 4, 1, 3, 7, 5, 4, 0, 1, 5, 4,
                                               4, 2, 6, 7, 3, 4, 0, 2, 3, 1, 4, 4, 5, 7, 6}));
  const Eigen::Matrix3d turn = Eigen::Quaterniond(0.8, 0.3, -0.2, 0.4).normalized().matrix();
  for (const double stretch : {0.0, 4e-10, -4e-10}) {
    for (const double sigma : {1.0, 0.1, 1e-3}) {
      fcl::Transform3d pose_b(turn * (1.0 + stretch));
      pose_b.translation() = turn * Eigen::Vector3d(2.0 + 2.0 * sigma, 0.1, 0.1);
      const auto displacement = GaussianDisplacement::fromStandardDeviations({sigma, sigma, sigma});
      const fcl::Transform3d pose_a(turn);
      // Along an axis of the boxes, which are 2 and 2 (1 + stretch) wide.
      const auto exact = [&](double move) {
        const double half = 1.0 + (1.0 + stretch);
        return normalIntervalMass((move - half) / sigma, (move + half) / sigma);
      };
      const double p = exact(2.0 + 2.0 * sigma) * exact(0.1) * exact(0.1);
      for (const fcl::ShapeBased* shape : {static_cast<const fcl::ShapeBased*>(&box),
                                           static_cast<const fcl::ShapeBased*>(&cube)}) {
        const auto result = answer(*shape, pose_a, *shape, pose_b, displacement);
        CAPTURE(stretch, sigma, p, *result.lower, *result.upper);
        CHECK(result.method == ProbabilityMethod::exact);
        CHECK(*result.lower <= p);
        CHECK(*result.upper >= p);
        CHECK(*result.upper - *result.lower < 1e-8 * p);
      }
    }
  }
}

TEST_CASE("a standard deviation so small that whitened lengths overflow") {
  const fcl::Boxd box(1, 2, 3);
  const fcl::Cylinderd cylinder(0.5, 1.0);
  for (const double sigma : {1e-80, 1e-110, 1e-160, 1e-300}) {
    const auto displacement = GaussianDisplacement::fromStandardDeviations({sigma, 1.0, 1.0});
    // Without it along x: how far A may move along y before the cylinder's side is no longer met
    // depends on x only.
    const double reach = 1.0 + std::sqrt(0.25 - 0.4 * 0.4);
    const double p = normalIntervalMass(-reach - 0.5, reach - 0.5) * normalIntervalMass(-2.2, 1.8);
    for (const auto method : {ProbabilityMethod::automatic, ProbabilityMethod::interval,
                              ProbabilityMethod::exact, ProbabilityMethod::convex_pcd}) {
      CAPTURE(sigma, toString(method), p);
      ProbabilityRequest request;
      request.method = method;
      request.max_cells = 100;
      const auto result =
          answer(box, at({0.9, 0.5, 0.2}), cylinder, kIdentity, displacement, request);
      CHECK(result.lower.value_or(0.0) <= p);
      CHECK(*result.upper >= p);
      CHECK(*result.upper <= 1.0);
    }
  }
}

TEST_CASE("displacements of rank 1 and 2 between boxes") {
  const fcl::Boxd box(1, 1, 1);
  const auto line = GaussianDisplacement::fromStandardDeviations({0.5, 0, 0});
  CHECK(answer(box, kIdentity, box, at({1.5, 0.2, 0.3}), line).probability() ==
        Approx(normalTailMass(1) - normalTailMass(5)).epsilon(1e-9));
  CHECK(answer(box, kIdentity, box, at({1.5, 1.2, 0.3}), line).probability() < 1e-12);
  const auto plane = GaussianDisplacement::fromStandardDeviations({0.5, 0.25, 0});
  CHECK(answer(box, kIdentity, box, at({1.5, 1.25, 0.3}), plane).probability() ==
        Approx((normalTailMass(1) - normalTailMass(5)) * (normalTailMass(1) - normalTailMass(9)))
            .epsilon(1e-9));
}

TEST_CASE("pairs beyond reach stop at the root") {
  const auto a = makeModel<fcl::OBBRSSd>(bumpyMesh(0.5, 8, 12, 1));
  const auto b = makeModel<fcl::KDOPd<18>>(torusMesh(0.5, 0.2, 12, 8));
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  const auto far = answer(*a, kIdentity, *b, at({2.4, 0, 0}), displacement);
  CHECK(planMentions(far, "stopped at the bound of the root"));
  CHECK(*far.lower == 0.0);
  CHECK(*far.upper <= 1e-6);
  CHECK(*far.upper > 0.0);
  CHECK(far.status == ProbabilityStatus::converged);
  CHECK(far.statistics.cells == 0);
  ProbabilityRequest request;
  request.threshold = 0.05;
  const auto decided = answer(*a, kIdentity, *b, at({1.9, 0, 0}), displacement, request);
  CHECK(decided.decision == Decision::below);
  CHECK(planMentions(decided, "stopped at the bound of the root"));
  const auto near = answer(*a, kIdentity, *b, at({1.1, 0, 0}), displacement);
  CHECK_FALSE(planMentions(near, "stopped at"));
  CHECK(planMentions(near, "root volumes: their bound decides nothing"));
  CHECK(near.statistics.cells > 0);
}

TEST_CASE("methods refuse the pairs that they cannot handle, by name") {
  const auto mesh = makeModel<fcl::OBBRSSd>(boxMesh({1, 1, 1}));
  const auto other = makeModel<fcl::AABBd>(boxMesh({1, 1, 1}));
  const fcl::Sphered sphere(1);
  const fcl::Halfspaced halfspace(0, 0, 1, 0);
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  const auto refusal = [&](const fcl::CollisionGeometryd& a, const fcl::CollisionGeometryd& b,
                           ProbabilityMethod method, ContactMeaning contact) -> std::string {
    ProbabilityRequest request;
    request.method = method;
    request.contact = contact;
    try {
      answer(a, kIdentity, b, kIdentity, displacement, request);
    } catch (const UnsupportedGeometry& exception) {
      return exception.what();
    }
    return "";
  };
  using Method = ProbabilityMethod;
  const auto fcl_contact = ContactMeaning::fcl;
  CHECK_THAT(refusal(*mesh, sphere, Method::exact, fcl_contact),
             Contains("exact") && Contains("Sphere"));
  CHECK_THAT(refusal(halfspace, sphere, Method::convex_pcd, fcl_contact),
             Contains("convex-pcd") && Contains("Halfspace"));
  CHECK_THAT(refusal(*mesh, *other, Method::monte_carlo, fcl_contact), Contains("BVHModel<AABB>"));
  CHECK_THAT(refusal(*mesh, *other, Method::rare_event, fcl_contact), Contains("BVHModel<AABB>"));
  CHECK_THAT(refusal(*mesh, *mesh, Method::general_pcd, ContactMeaning::solid),
             Contains("general-pcd"));
  CHECK(refusal(*mesh, *other, Method::automatic, fcl_contact).empty());
  CHECK(refusal(*mesh, *mesh, Method::automatic, ContactMeaning::solid).empty());
}

TEST_CASE("solids: containment in closed meshes counts if asked for") {
  const auto outer = makeModel<fcl::OBBRSSd>(sphereMesh(2, 12, 16));
  const auto inner = makeModel<fcl::OBBRSSd>(sphereMesh(0.2, 6, 8));
  const auto displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  ProbabilityRequest request;
  CHECK(answer(*inner, kIdentity, *outer, kIdentity, displacement, request).probability() < 1e-6);
  request.contact = ContactMeaning::solid;
  CHECK(answer(*inner, kIdentity, *outer, kIdentity, displacement, request).probability() ==
        Approx(1.0).epsilon(0.01));
}
