// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex polytopes that move in a plane, against products of intervals in 34 digits and against
// sections of their faces in doubles.
#include "exact/polytope_section.h"

#include <fcl/geometry/shape/box.h>

#include <algorithm>
#include <vector>

#include "bounds/pair_bounds.h"
#include "catch.h"
#include "convex/pair_obstacle.h"
#include "disc_truth.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using fcl_prob::Bounds;
using fcl_prob::ConvexBody;
using fcl_prob::GaussianDisplacement;
using fcl_prob::detail::polytopeSectionMass;
using Number = QuadPrecision;

/// 1 if P is too small for a double.
double widthAround(const Bounds& mass, const Number& truth) {
  INFO("from " << mass.lower << " to " << mass.upper << ", truth " << truth);
  CHECK(Number(mass.lower) <= truth);
  CHECK(Number(mass.upper) >= truth);
  return truth > Number(1e-280) ? mass.width() / mass.upper : 1.0;
}

TEST_CASE("boxes along the axes of a displacement in a plane, of all sizes, in 34 digits") {
  RandomBodies random(401);
  std::vector<double> widths;
  for (int i = 0; i < 600; ++i) {
    const double sigma[] = {1.0, random.logUniform(0.1, 1.0)};
    const double size = random.logUniform(1e-3, 1e3);
    Eigen::Vector3d a, b, place(0.0, 0.0, 0.0);
    Number truth = 1;
    for (int k = 0; k < 3; ++k) {
      a[k] = size * random.uniform(0.2, 1.0);
      b[k] = size * random.uniform(0.2, 1.0);
      const double half = 0.5 * (a[k] + b[k]);
      if (k == 2) place[k] = random.uniform(-0.9, 0.9) * half;
      if (k == 2) continue;
      place[k] = i % 3 ? half + random.uniform(-1.0, 25.0) * sigma[k] : random.uniform(-1.0, 1.0);
      const Number reach = (Number(a[k]) + Number(b[k])) / 2;
      truth *= intervalOf<Number>((place[k] - reach) / sigma[k], (place[k] + reach) / sigma[k]);
    }
    Eigen::Isometry3d pose_b = Eigen::Isometry3d::Identity();
    pose_b.translation() = place;
    const auto displacement =
        GaussianDisplacement::fromStandardDeviations({sigma[0], sigma[1], 0.0});
    const Bounds mass = polytopeSectionMass(ConvexBody(fcl::Boxd(a)), Eigen::Isometry3d::Identity(),
                                            ConvexBody(fcl::Boxd(b)), pose_b, displacement, {});
    INFO("size " << size << ", number " << i);
    const double width = widthAround(mass, truth);
    if (width < 1.0) widths.push_back(width);
  }
  std::sort(widths.begin(), widths.end());
  CHECK(widths.size() > 400);
  CHECK(widths[widths.size() / 2] < 2e-11);
  CHECK(widths[widths.size() * 9 / 10] < 1e-10);
  CHECK(widths.back() < 1e-8);
}

TEST_CASE("boxes along the axes of a displacement along a line, of all sizes, in 34 digits") {
  RandomBodies random(404);
  std::vector<double> widths;
  for (int i = 0; i < 600; ++i) {
    const double size = random.logUniform(1e-3, 1e3);
    Eigen::Vector3d a, b, place;
    for (int k = 0; k < 3; ++k) {
      a[k] = size * random.uniform(0.2, 1.0);
      b[k] = size * random.uniform(0.2, 1.0);
      place[k] = random.uniform(-0.49, 0.49) * (a[k] + b[k]);
    }
    if (i % 3) place.x() = 0.5 * (a.x() + b.x()) + random.uniform(-1.0, 35.0);
    const Number reach = (Number(a.x()) + Number(b.x())) / 2;
    const Number truth = intervalOf<Number>(place.x() - reach, place.x() + reach);
    Eigen::Isometry3d pose_b = Eigen::Isometry3d::Identity();
    pose_b.translation() = place;
    const auto displacement = GaussianDisplacement::fromStandardDeviations({1.0, 0.0, 0.0});
    const Bounds mass = polytopeSectionMass(ConvexBody(fcl::Boxd(a)), Eigen::Isometry3d::Identity(),
                                            ConvexBody(fcl::Boxd(b)), pose_b, displacement, {});
    INFO("size " << size << ", number " << i);
    const double width = widthAround(mass, truth);
    if (width < 1.0) widths.push_back(width);
  }
  std::sort(widths.begin(), widths.end());
  CHECK(widths.size() > 400);
  CHECK(widths[widths.size() / 2] < 2e-11);
  CHECK(widths[widths.size() * 9 / 10] < 1e-10);
  // Where the line grazes an edge.
  CHECK(widths.back() < 1e-8);
}

/// Where the outline of a unit square, of which the corners are given, has a height.
std::pair<Number, Number> outlineAt(const Number& height, const Number& c, const Number& s) {
  const Number x[] = {(c + s) / 2, (s - c) / 2, -(c + s) / 2, (c - s) / 2};
  const Number z[] = {(c - s) / 2, (c + s) / 2, (s - c) / 2, -(c + s) / 2};
  Number least = 10, most = -10;
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) % 4;
    if ((z[k] < height) == (z[next] < height)) continue;
    const Number at = x[k] + (height - z[k]) / (z[next] - z[k]) * (x[next] - x[k]);
    least = std::min(least, at);
    most = std::max(most, at);
  }
  return {least, most};
}

TEST_CASE("cubes cut at an angle by the plane in which they move, in 34 digits") {
  RandomBodies random(402);
  const ConvexBody point(std::vector<Eigen::Vector3d>{Eigen::Vector3d::Zero()});
  const ConvexBody cube(fcl::Boxd(1, 1, 1));
  for (int i = 0; i < 300; ++i) {
    const double angle = random.uniform(0.01, 1.5);
    Eigen::Isometry3d pose(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()));
    const double c = pose.linear()(0, 0), s = pose.linear()(0, 2);
    const double height = random.uniform(-0.95, 0.95) * 0.5 * (c + s);
    const double sigma[] = {random.logUniform(0.01, 10.0), random.logUniform(0.01, 10.0)};
    const double far = 0.7 + random.uniform(-1.0, 20.0) * sigma[0];
    pose.translation() = Eigen::Vector3d(far, 0.1, -height);
    const auto [least, most] = outlineAt(height, c, s);
    const Number along =
        intervalOf<Number>((least + Number(far)) / sigma[0], (most + Number(far)) / sigma[0]);
    const Number beside = intervalOf<Number>((Number(0.1) - Number(0.5)) / sigma[1],
                                             (Number(0.1) + Number(0.5)) / sigma[1]);
    const auto displacement =
        GaussianDisplacement::fromStandardDeviations({sigma[0], sigma[1], 0.0});
    const Bounds mass =
        polytopeSectionMass(point, Eigen::Isometry3d::Identity(), cube, pose, displacement, {});
    INFO("number " << i << ", angle " << angle);
    CHECK(widthAround(mass, along * beside) < (along * beside > Number(1e-280) ? 1e-9 : 2.0));
  }
}

TEST_CASE(
    "hulls that move in any plane or along any line: what is told agrees with sections in "
    "doubles") {
  RandomBodies random(403);
  int told = 0;
  for (int i = 0; i < 300; ++i) {
    const bool in_plane = i % 3 != 0;
    const ConvexBody a(random.onSphere(4 + i % 20, random.uniform(0.2, 1.0)));
    const ConvexBody b(random.cloud(4 + i % 30, 1.0));
    const auto displacement = GaussianDisplacement::fromStandardDeviations(
        {random.logUniform(0.05, 5.0), in_plane ? random.logUniform(0.05, 5.0) : 0.0, 0.0},
        random.quaternion());
    const Eigen::Isometry3d pose_a = random.pose(1.0), pose_b = random.pose(in_plane ? 3.0 : 1.0);
    const Bounds mass = polytopeSectionMass(a, pose_a, b, pose_b, displacement, {});
    const auto frame = fcl_prob::detail::pairFrame(a, pose_a, b, pose_b, displacement);
    const fcl_prob::detail::PairObstacle obstacle(frame, a.set(), b.set());
    fcl_prob::detail::PairBounds pair;
    const Bounds other = pair.mass(*obstacle);
    INFO("number " << i << ": " << mass.lower << " to " << mass.upper << ", in doubles "
                   << other.lower << " to " << other.upper);
    CHECK(mass.lower <= other.upper);
    CHECK(mass.upper >= other.lower);
    if (mass.lower < 1e-280) continue;
    ++told;
    CHECK(mass.width() <= 1e-9 * mass.upper);
  }
  CHECK(told > 100);
}

}  // namespace
