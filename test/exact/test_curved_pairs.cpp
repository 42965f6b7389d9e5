// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Ellipsoids, cylinders and cones: against closed forms in 100 digits, quadrature over sections,
// the same pair given in other ways, and fcl::collide.
#include "exact/curved_pair.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <memory>

#include "catch.h"
#include "curved_cases.h"
#include "fcl_prob/convex_pcd.h"
#include "poses.h"
#include "section_truth.h"
#include "shapes.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob;
using Eigen::Vector3d;
using Precise = boost::multiprecision::cpp_bin_float_100;
using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;
using Pose = Eigen::Isometry3d;

constexpr double kWidth = 1e-6;

Bounds massOf(const fcl::CollisionGeometryd& a, const Pose& pose_a,
              const fcl::CollisionGeometryd& b, const Pose& pose_b,
              const GaussianDisplacement& error) {
  return convexPairMass(ConvexBody(a), pose_a, ConvexBody(b), pose_b, error);
}

/// Of a ball under N(0, I): with F(x) = Φ(x), at a distance d > 0,
/// F(d + r) - F(d - r) - (φ(d - r) - φ(d + r)) / d.
Precise ballMassAt(const Precise& d, const Precise& r) {
  const Precise half = sqrt(Precise(2));
  const auto density = [](const Precise& x) {
    return Precise(exp(-x * x / 2) / sqrt(2 * boost::math::constants::pi<Precise>()));
  };
  const Precise between =
      (boost::math::erfc(Precise((d - r) / half)) - boost::math::erfc(Precise((d + r) / half))) / 2;
  return between - (density(d - r) - density(d + r)) / d;
}

void checkHolds(const Bounds& mass, double truth, double truth_error, double width = kWidth) {
  INFO(mass.lower << " to " << mass.upper << ", truth " << truth);
  CHECK(mass.lower <= truth * (1.0 + truth_error));
  CHECK(mass.upper >= truth * (1.0 - truth_error));
  CHECK(mass.width() <= width * mass.upper);
}

TEST_CASE("homothetic ellipsoids are balls in another frame: closed form in 100 digits") {
  RandomBodies random(301);
  for (int k = 0; k < 60; ++k) {
    const double scale = random.logUniform(0.01, 100.0);
    const Vector3d axes = scale * Vector3d(1.0, random.uniform(0.1, 1.0), random.uniform(0.1, 1.0));
    const double more = random.uniform(0.2, 3.0), sigma = random.logUniform(0.03, 30.0);
    const fcl::Ellipsoidd a(axes.x(), axes.y(), axes.z());
    const Vector3d larger = more * axes;
    const fcl::Ellipsoidd b(larger.x(), larger.y(), larger.z());
    // In the frame in which A is the unit ball deviations are sigma along every axis.
    const auto error = GaussianDisplacement::fromStandardDeviations(sigma * axes);
    const double radius = (1.0 + more) / sigma;
    const double distance =
        k % 3 == 0 ? random.uniform(0.1, 1.0) * radius : radius + random.logUniform(0.1, 30.0);
    const Pose pose = at(distance * sigma * axes.cwiseProduct(random.direction()));
    const Vector3d unit = pose.translation().cwiseQuotient(sigma * axes);
    const Precise truth =
        ballMassAt(sqrt(Precise(unit.x()) * unit.x() + Precise(unit.y()) * unit.y() +
                        Precise(unit.z()) * unit.z()),
                   Precise(1.0 + more) / sigma);
    if (truth < 1e-250) continue;
    const Bounds mass = massOf(a, Pose::Identity(), b, pose, error);
    INFO("radius " << radius << ", distance " << distance << ", " << axes.transpose());
    checkHolds(mass, static_cast<double>(truth), 1e-11);
    CHECK(std::abs(mass.middle() / static_cast<double>(truth) - 1.0) < 0.5 * kWidth);
  }
}

/// A frustum swept by a ball: the largest distance from the axis at a height.
double sweptRadius(double half_height, double bottom, double top, double ball, double z) {
  // The generating curve: arcs around both rims and a segment between them.
  const double slant = std::hypot(2.0 * half_height, bottom - top);
  const double up = (bottom - top) / slant, out = 2.0 * half_height / slant;
  const double from = -half_height + ball * up, to = half_height + ball * up;
  const auto arc = [&](double centre, double radius) {
    const double h = z - centre;
    return radius + std::sqrt(std::max(0.0, (ball - h) * (ball + h)));
  };
  if (z < from) return arc(-half_height, bottom);
  if (z > to) return arc(half_height, top);
  const double share = (z - from) / (to - from);
  return bottom + share * (top - bottom) + ball * out;
}

/// Of the same solid under deviations that are equal across its axis.
double sweptMass(double half_height, double bottom, double top, double ball, double across,
                 double along, double sigma, double sigma_along) {
  const double slant = std::hypot(2.0 * half_height, bottom - top);
  const double shift = ball * (bottom - top) / slant;
  const double centre = along;
  return integrateOver({centre - half_height - ball, centre - half_height + shift,
                        centre + half_height + shift, centre + half_height + ball},
                       [&](double z) {
                         const double radius =
                             sweptRadius(half_height, bottom, top, ball, z - centre);
                         return densityAt(z / sigma_along) / sigma_along *
                                discMassAt(across / sigma, radius / sigma);
                       });
}

TEST_CASE("cylinders and cones beside spheres against quadrature over their sections") {
  RandomBodies random(302);
  for (int k = 0; k < 24; ++k) {
    const double radius = random.uniform(0.2, 1.5), length = random.uniform(0.4, 3.0);
    const double ball = random.uniform(0.1, 1.0);
    const bool is_cone = k % 2 == 1;
    const std::unique_ptr<fcl::CollisionGeometryd> shape =
        is_cone ? std::unique_ptr<fcl::CollisionGeometryd>(new fcl::Coned(radius, length))
                : std::unique_ptr<fcl::CollisionGeometryd>(new fcl::Cylinderd(radius, length));
    const fcl::Sphered sphere(ball);
    const double sigma = random.uniform(0.3, 1.0), sigma_along = random.uniform(0.3, 1.0);
    const double across = random.uniform(0.0, 6.0), along = random.uniform(-3.0, 3.0);
    const double angle = random.uniform(0.0, 2.0 * M_PI);
    // The shape is B, at this place seen from A, and turned with everything else.
    const auto turn = random.quaternion();
    Pose pose_a = Pose::Identity(),
         pose_b = at(turn * Vector3d(across * std::cos(angle), across * std::sin(angle), along));
    pose_b.linear() = turn.toRotationMatrix();
    const auto error =
        GaussianDisplacement::fromStandardDeviations({sigma, sigma, sigma_along}, turn);
    const double truth = sweptMass(0.5 * length, radius, is_cone ? 0.0 : radius, ball, across,
                                   along, sigma, sigma_along);
    INFO((is_cone ? "cone " : "cylinder ")
         << radius << " " << length << " " << ball << " at " << across << ", " << along);
    checkHolds(massOf(sphere, pose_a, *shape, pose_b, error), truth, 1e-8);
    // The other way round: A is seen from B.
    checkHolds(massOf(*shape, pose_b, sphere, pose_a, error), truth, 1e-8);
  }
}

/// Mass of a rectangle swept by a disc, in the plane.
double sweptRectangle(double half_x, double half_y, double disc, double x, double y, double sx,
                      double sy) {
  return integrateOver({-half_x - disc, -half_x, half_x, half_x + disc}, [&](double u) {
    const double beyond = std::max(0.0, std::abs(u) - half_x);
    const double half = half_y + std::sqrt(std::max(0.0, (disc - beyond) * (disc + beyond)));
    return densityAt((x + u) / sx) / sx * massBetween((y - half) / sy, (y + half) / sy);
  });
}

TEST_CASE("a cylinder beside a box of the same axes is a product, ties and all") {
  RandomBodies random(303);
  for (int k = 0; k < 40; ++k) {
    const Vector3d side(random.uniform(0.2, 2.0), random.uniform(0.2, 2.0),
                        random.uniform(0.2, 2.0));
    const double radius = random.uniform(0.1, 1.5), length = random.uniform(0.2, 2.0);
    const Vector3d sigma(random.uniform(0.2, 1.0), random.uniform(0.2, 1.0),
                         random.uniform(0.2, 1.0));
    const Vector3d place(random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0),
                         random.uniform(-3.0, 3.0));
    const double half_z = 0.5 * (side.z() + length);
    const double truth =
        sweptRectangle(0.5 * side.x(), 0.5 * side.y(), radius, place.x(), place.y(), sigma.x(),
                       sigma.y()) *
        massBetween((place.z() - half_z) / sigma.z(), (place.z() + half_z) / sigma.z());
    const auto error = GaussianDisplacement::fromStandardDeviations(sigma);
    INFO(side.transpose() << ", " << radius << " " << length << " at " << place.transpose());
    checkHolds(massOf(fcl::Cylinderd(radius, length), Pose::Identity(),
                      fcl::Boxd(side.x(), side.y(), side.z()), at(place), error),
               truth, 1e-8);
  }
}

std::vector<std::pair<Geometry, Geometry>> curvedPairs(RandomBodies& random, double size) {
  const auto length = [&] { return size * random.uniform(0.2, 1.0); };
  const Geometry sphere = std::make_shared<fcl::Sphered>(length());
  const Geometry box = std::make_shared<fcl::Boxd>(length(), length(), length());
  const Geometry capsule = std::make_shared<fcl::Capsuled>(0.5 * length(), length());
  const Geometry ellipsoid = std::make_shared<fcl::Ellipsoidd>(length(), length(), length());
  const Geometry other = std::make_shared<fcl::Ellipsoidd>(length(), length(), length());
  const Geometry cylinder = std::make_shared<fcl::Cylinderd>(0.5 * length(), length());
  const Geometry column = std::make_shared<fcl::Cylinderd>(0.5 * length(), length());
  const Geometry cone = std::make_shared<fcl::Coned>(0.5 * length(), length());
  const Geometry spike = std::make_shared<fcl::Coned>(0.5 * length(), length());
  const Geometry hull = randomConvex(30, 0.5 * size, static_cast<unsigned>(random.integer(0, 999)));
  return {{ellipsoid, other}, {ellipsoid, sphere}, {ellipsoid, capsule}, {ellipsoid, cylinder},
          {cone, ellipsoid},  {box, ellipsoid},    {ellipsoid, hull},    {cylinder, sphere},
          {sphere, cone},     {cylinder, box},     {box, cone},          {hull, cylinder},
          {cone, hull},       {cylinder, column},  {capsule, cylinder},  {cone, cylinder},
          {capsule, cone},    {cone, spike}};
}

std::string nameOf(const std::pair<Geometry, Geometry>& pair) {
  return std::to_string(pair.first->getNodeType()) + " and " +
         std::to_string(pair.second->getNodeType());
}

TEST_CASE("curved pairs of all sizes and distances are certified to six digits") {
  RandomBodies random(304);
  int asked = 0, wide = 0;
  for (const double size : {1e-2, 0.3, 1.0, 10.0, 100.0}) {
    for (const double distance : {0.0, 2.0, 8.0, 25.0}) {
      for (const auto& pair : curvedPairs(random, size)) {
        const Vector3d deviations(1.0, random.uniform(0.3, 1.0), random.uniform(0.3, 1.0));
        const auto error =
            GaussianDisplacement::fromStandardDeviations(deviations, random.quaternion());
        const Pose pose_a = random.pose(0.1);
        Pose pose_b = random.pose(0.0);
        pose_b.translation() = (0.5 * size + 0.4 * distance) * random.direction();
        const Bounds mass = massOf(*pair.first, pose_a, *pair.second, pose_b, error);
        if (mass.upper < 1e-250) continue;
        INFO(nameOf(pair) << ", size " << size << ": " << mass.lower << " to " << mass.upper);
        CHECK(mass.width() <= 3.0 * kWidth * mass.upper);
        ++asked;
        wide += mass.width() > kWidth * mass.upper;
      }
    }
  }
  CHECK(wide * 20 <= asked);
}

TEST_CASE("curved pairs have the same mass swapped, turned and scaled") {
  RandomBodies random(305);
  for (int k = 0; k < 6; ++k) {
    for (const auto& pair : curvedPairs(random, 1.0)) {
      const GaussianDisplacement error = randomDisplacement(random, 0.1, 1.0);
      const Pose a = random.pose(1.0), b = random.pose(2.0);
      const Bounds mass = massOf(*pair.first, a, *pair.second, b, error);
      INFO(nameOf(pair) << ": " << mass.lower << " to " << mass.upper);
      const auto overlaps = [&](const Bounds& other) {
        CHECK(other.lower <= mass.upper * (1.0 + 1e-10));
        CHECK(mass.lower <= other.upper * (1.0 + 1e-10));
      };
      overlaps(massOf(*pair.second, b, *pair.first, a, error));
      Pose turn = random.pose(3.0);
      overlaps(massOf(*pair.first, turn * a, *pair.second, turn * b, error.rotated(turn.linear())));
    }
  }
}

TEST_CASE("curved pairs against fcl::collide at random displacements") {
  RandomBodies random(306);
  for (int k = 0; k < 4; ++k) {
    for (const auto& pair : curvedPairs(random, 1.0)) {
      const GaussianDisplacement error = randomDisplacement(random, 0.2, 1.0);
      const Pose pose_a = random.pose(0.3), pose_b = random.pose(1.0);
      const Bounds mass = massOf(*pair.first, pose_a, *pair.second, pose_b, error);
      constexpr int kSamples = 4000;
      int hits = 0;
      for (int n = 0; n < kSamples; ++n) {
        Pose moved = pose_a;
        moved.translation() +=
            error.axes() * error.standardDeviations().cwiseProduct(random.normalVector());
        fcl::CollisionResultd contact;
        fcl::collide(pair.first.get(), moved, pair.second.get(), pose_b, fcl::CollisionRequestd(),
                     contact);
        hits += contact.isCollision();
      }
      const double p = mass.middle(), share = static_cast<double>(hits) / kSamples;
      INFO(nameOf(pair) << ": " << mass.lower << " to " << mass.upper << ", samples " << share);
      CHECK(std::abs(share - p) <= 5.0 * std::sqrt(p * (1.0 - p) / kSamples + 1e-8));
    }
  }
}

/// Prisms and pyramids inside and around a cylinder or a cone.
ConvexBody prism(double radius, double top, double length, bool around, int corners = 40) {
  const double scale = around ? 1.0 / std::cos(M_PI / corners) : 1.0;
  std::vector<Vector3d> points;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2.0 * M_PI * k / corners;
    const Vector3d rim(std::cos(angle), std::sin(angle), 0.0);
    points.push_back(scale * radius * rim - 0.5 * length * Vector3d::UnitZ());
    if (top > 0.0 || k == 0) points.push_back(scale * top * rim + 0.5 * length * Vector3d::UnitZ());
  }
  return ConvexBody(points);
}

TEST_CASE("needles, plates and covariances of ratios up to 1e6 hold what polytopes enclose") {
  RandomBodies random(307);
  for (int k = 0; k < 60; ++k) {
    const double radius = random.logUniform(1e-4, 1.0), length = random.logUniform(1e-4, 1.0);
    const double ratio = random.logUniform(1.0, 1e6);
    const auto error = GaussianDisplacement::fromStandardDeviations(
        {0.3, 0.3 / std::sqrt(ratio), 0.3 / ratio}, random.quaternion());
    const Pose pose_a = random.pose(0.1), pose_b = random.pose(0.5);
    const bool is_cone = k % 2 == 1;
    const double top = is_cone ? 0.0 : radius;
    const ConvexBody shape = is_cone ? ConvexBody(fcl::Coned(radius, length))
                                     : ConvexBody(fcl::Cylinderd(radius, length));
    const ConvexBody other = k % 3 == 0   ? ConvexBody(fcl::Sphered(random.logUniform(1e-3, 0.5)))
                             : k % 3 == 1 ? ConvexBody(fcl::Boxd(0.3, 0.001, 0.4))
                                          : ConvexBody(random.cloud(12, 0.4));
    const Bounds mass = detail::curvedPairMass(shape, pose_a, other, pose_b, error, {}).mass;
    const Bounds least =
        convexPairMass(prism(radius, top, length, false), pose_a, other, pose_b, error);
    const Bounds most =
        convexPairMass(prism(radius, top, length, true), pose_a, other, pose_b, error);
    INFO(radius << " " << length << ", ratio " << ratio << ": " << mass.lower << " to "
                << mass.upper << ", polytopes " << least.lower << " to " << most.upper);
    CHECK(mass.lower <= most.upper);
    CHECK(mass.upper >= least.lower);
    CHECK(mass.lower <= mass.upper);
  }
}

TEST_CASE("bodies of a thousand deviations along one axis are certified to 1e-6") {
  RandomBodies random(310);
  for (int k = 0; k < 6; ++k) {
    const auto error =
        GaussianDisplacement::fromStandardDeviations({1.0, 0.1, 1e-3}, random.quaternion());
    const ConvexBody shape =
        k % 2 == 0 ? ConvexBody(fcl::Cylinderd(random.uniform(0.3, 0.6), random.uniform(0.5, 1)))
                   : ConvexBody(fcl::Ellipsoidd(0.3, random.uniform(0.3, 0.6), 0.5));
    const ConvexBody other = ConvexBody(fcl::Sphered(random.uniform(0.3, 0.6)));
    const Pose pose_a = random.pose(0.0), pose_b = random.pose(0.6);
    const Bounds mass = detail::curvedPairMass(shape, pose_a, other, pose_b, error, {}).mass;
    INFO(k << ": " << mass.lower << " to " << mass.upper);
    CHECK(mass.lower > 0.0);
    CHECK(mass.width() <= 1e-6 * mass.upper);
  }
}

TEST_CASE("two cylinders and a capsule and a cylinder of parallel axes against sections") {
  RandomBodies random(308);
  for (int k = 0; k < 12; ++k) {
    const CoaxialPair pair(random);
    const double half = 0.5 * (pair.length + pair.longer);
    const auto error = pair.error();
    const Pose pose = at({pair.across, 0.0, pair.along});
    const double product =
        discMassAt(pair.across / pair.sigma, (pair.radius + pair.other) / pair.sigma) *
        massBetween((pair.along - half) / pair.sigma_along, (pair.along + half) / pair.sigma_along);
    checkHolds(massOf(fcl::Cylinderd(pair.radius, pair.length), Pose::Identity(),
                      fcl::Cylinderd(pair.other, pair.longer), pose, error),
               product, 1e-8);
    checkHolds(massOf(fcl::Capsuled(pair.other, pair.longer), Pose::Identity(),
                      fcl::Cylinderd(pair.radius, pair.length), pose, error),
               sweptMass(half, pair.radius, pair.radius, pair.other, pair.across, pair.along,
                         pair.sigma, pair.sigma_along),
               1e-8);
  }
}

TEST_CASE("axes that are nearly parallel or perpendicular hold what polytopes enclose") {
  RandomBodies random(309);
  const double radius = 0.3, length = 1.1, other = 0.2, longer = 0.8;
  for (const double tilt : {0.0, 1e-14, 1e-12, 1e-10, 1e-7, 1e-3}) {
    for (const double from : {0.0, M_PI_2}) {
      for (const bool is_capsule : {false, true}) {
        const TiltedPair pair(from + tilt, random);
        const auto& [error, pose_a, pose_b] = pair;
        const ConvexBody cylinder(fcl::Cylinderd(radius, length));
        const fcl::Capsuled capsule(other, longer);
        const auto second = [&](bool around) {
          return is_capsule ? ConvexBody(capsule) : prism(other, other, longer, around);
        };
        const ConvexBody shape =
            is_capsule ? ConvexBody(capsule) : ConvexBody(fcl::Cylinderd(other, longer));
        const Bounds mass = detail::curvedPairMass(cylinder, pose_a, shape, pose_b, error, {}).mass;
        const Bounds least = convexPairMass(prism(radius, radius, length, false), pose_a,
                                            second(false), pose_b, error);
        const Bounds most = convexPairMass(prism(radius, radius, length, true), pose_a,
                                           second(true), pose_b, error);
        INFO("tilt " << tilt << " from " << from << ": " << mass.lower << " to " << mass.upper
                     << ", polytopes " << least.lower << " to " << most.upper);
        CHECK(mass.lower <= most.upper);
        CHECK(mass.upper >= least.lower);
        // In between, normals turn fast; where that takes too many boxes polytopes are as before.
        if (tilt <= 1e-12) CHECK(mass.width() <= kWidth * mass.upper);
      }
    }
  }
}

TEST_CASE("a quadrature that is interrupted knows nothing, or what it knew") {
  const ConvexBody ellipsoid(fcl::Ellipsoidd(0.3, 0.2, 0.4)), cylinder(fcl::Cylinderd(0.3, 0.5));
  const auto error = GaussianDisplacement::fromStandardDeviations({0.1, 0.2, 0.05});
  const Pose pose = at({0.7, 0.2, 0.1});
  const auto massWithin = [&](int asked) {
    return detail::curvedPairMass(ellipsoid, Pose::Identity(), cylinder, pose, error,
                                  {false, [&asked] { return --asked < 0; }})
        .mass;
  };
  const Bounds whole = massWithin(1'000'000);
  CHECK(whole.width() <= kWidth * whole.upper);
  for (const int asked : {0, 1, 10, 100}) {
    const Bounds part = massWithin(asked);
    CHECK(part.lower <= whole.lower);
    CHECK(part.upper >= whole.upper);
  }
}

TEST_CASE("cones beside what has an axis, in all ties, hold what polytopes enclose") {
  RandomBodies random(311);
  const double radius = 0.3, length = 0.9, other = 0.2, longer = 0.7;
  const double opening = std::atan2(radius, length), second_opening = std::atan2(other, longer);
  for (const double tilt : {0.0, 1e-14, 1e-12, 1e-10, 1e-6, 1e-3}) {
    for (const double from : {0.0, M_PI_2, M_PI, opening, second_opening, M_PI_2 - opening,
                              opening + second_opening, M_PI - opening - second_opening}) {
      for (const double top : {other, 0.0}) {
        const TiltedPair pair(from + tilt, random);
        const auto& [error, pose_a, pose_b] = pair;
        const ConvexBody cone(fcl::Coned(radius, length));
        const ConvexBody shape = top > 0.0 ? ConvexBody(fcl::Cylinderd(other, longer))
                                           : ConvexBody(fcl::Coned(other, longer));
        const Bounds mass = detail::curvedPairMass(cone, pose_a, shape, pose_b, error, {}).mass;
        const Bounds least = convexPairMass(prism(radius, 0.0, length, false), pose_a,
                                            prism(other, top, longer, false), pose_b, error);
        const Bounds most = convexPairMass(prism(radius, 0.0, length, true), pose_a,
                                           prism(other, top, longer, true), pose_b, error);
        INFO("tilt " << tilt << " from " << from << ", top " << top << ": " << mass.lower << " to "
                     << mass.upper << ", polytopes " << least.lower << " to " << most.upper);
        CHECK(mass.lower <= most.upper);
        CHECK(mass.upper >= least.lower);
        // Where a side is along the other one, or a normal of a side along the other axis, normals
        // turn too fast for the boxes: polytopes are left.
        const bool is_plain = from == 0.0 || from == M_PI_2 || from == M_PI;
        if (tilt <= 1e-12 && is_plain) CHECK(mass.width() <= kWidth * mass.upper);
      }
    }
  }
}

TEST_CASE("cones beside cones and cylinders are between pyramids and prisms as circles are") {
  RandomBodies random(312);
  for (int k = 0; k < 12; ++k) {
    const double radius = random.uniform(0.2, 0.8), length = random.uniform(0.3, 1.2);
    const double other = random.uniform(0.1, 0.6), longer = random.uniform(0.3, 1.2);
    const double top = k % 2 == 0 ? other : 0.0;
    const auto error = randomDisplacement(random, 0.3, 0.9);
    const Pose pose_a = random.pose(0.2), pose_b = random.pose(1.5);
    const auto massOfPrisms = [&](bool around) {
      constexpr int kMany = 160;
      return convexPairMass(prism(radius, 0.0, length, around, kMany), pose_a,
                            prism(other, top, longer, around, kMany), pose_b, error)
          .middle();
    };
    // On an average the circle is a third of the way between their support functions, and two
    // thirds between their radii; the mass is somewhere between.
    const double least = massOfPrisms(false), most = massOfPrisms(true);
    const ConvexBody shape = top > 0.0 ? ConvexBody(fcl::Cylinderd(other, longer))
                                       : ConvexBody(fcl::Coned(other, longer));
    const Bounds mass = detail::curvedPairMass(ConvexBody(fcl::Coned(radius, length)), pose_a,
                                               shape, pose_b, error, {})
                            .mass;
    INFO(radius << " " << length << " and " << other << " " << longer << ": " << mass.lower
                << " to " << mass.upper << ", prisms " << least << " to " << most);
    CHECK(mass.width() <= kWidth * mass.upper);
    CHECK(mass.middle() >= least + 0.25 * (most - least));
    CHECK(mass.middle() <= least + 0.75 * (most - least));
    CHECK(most - least <= 3e-3 * most);
  }
}

TEST_CASE("all pairs of round and pointed shapes have a mass by their boundary") {
  const ConvexBody cone(fcl::Coned(0.3, 0.5)), capsule(fcl::Capsuled(0.2, 0.4)),
      cylinder(fcl::Cylinderd(0.2, 0.4)), sphere(fcl::Sphered(0.2));
  for (const ConvexBody* a : {&cone, &capsule, &cylinder, &sphere}) {
    for (const ConvexBody* b : {&cone, &cylinder}) CHECK(detail::isCurvedPair(*a, *b));
  }
}

}  // namespace
