// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The sphere of normals of two frustums: every normal is covered once, by a triangle of its region.
#include "exact/normal_overlay.h"

#include <Eigen/Geometry>
#include <cmath>

#include "catch.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob::detail;
using Eigen::Vector3d;

constexpr int kPieces = 400;

/// Normals nearer to a circle than chords of it are not asked.
constexpr double kClear = 2e-5;

NormalCircle circleOf(const Vector3d& axis, double lift) {
  return {axis, std::sqrt(1.0 - lift * lift), lift};
}

/// How often a triangle goes around a normal, its base being cut into chords.
int windingOf(const NormalOverlay& overlay, const NormalTriangle& triangle,
              const std::array<NormalCircle, 2>& circles, const Vector3d& normal) {
  const Vector3d &from = overlay.normal(triangle.from, 0), &to = overlay.normal(triangle.to, 0),
                 &apex = overlay.normal(triangle.apex, 0);
  const auto baseAt = [&](double share) -> Vector3d {
    const Vector3d chord = (1.0 - share) * from + share * to;
    if (triangle.circle < 0) return chord;
    const NormalCircle& circle = circles[static_cast<std::size_t>(triangle.circle)];
    const Vector3d across = chord - chord.dot(circle.axis) * circle.axis;
    return circle.cosine * across.normalized() + circle.lift * circle.axis;
  };
  int winding = 0;
  Vector3d begin = baseAt(0.0);
  for (int k = 1; k <= kPieces; ++k) {
    const Vector3d end = baseAt(static_cast<double>(k) / kPieces);
    const double sign = begin.cross(end).dot(apex) > 0.0 ? 1.0 : -1.0;
    const bool within = sign * begin.cross(end).dot(normal) > 0.0 &&
                        sign * end.cross(apex).dot(normal) > 0.0 &&
                        sign * apex.cross(begin).dot(normal) > 0.0;
    if (within) winding += sign > 0.0 ? 1 : -1;
    begin = end;
  }
  return winding;
}

void checkCovered(const std::array<NormalCircle, 2>& circles, RandomBodies& random) {
  const auto overlay = normalOverlay(circles);
  REQUIRE(overlay);
  const Vector3d north = circles[0].axis.cross(circles[1].axis).normalized();
  for (int n = 0; n < 20; ++n) {
    Vector3d normal = random.direction();
    if (normal.dot(north) < 0.0) normal = -normal;
    const double first = normal.dot(circles[0].axis) - circles[0].lift,
                 second = normal.dot(circles[1].axis) - circles[1].lift;
    if (std::min(std::abs(first), std::abs(second)) < kClear) continue;
    INFO("lifts " << circles[0].lift << " " << circles[1].lift << ", axes "
                  << circles[0].axis.dot(circles[1].axis) << ", normal " << first << " " << second);
    std::array<int, 4> winding{};
    for (const NormalTriangle& triangle : overlay->triangles) {
      winding[(triangle.above[0] ? 1u : 0u) + (triangle.above[1] ? 2u : 0u)] +=
          windingOf(*overlay, triangle, circles, normal);
    }
    const std::size_t region = (first > 0.0 ? 1u : 0u) + (second > 0.0 ? 2u : 0u);
    for (std::size_t k = 0; k < 4; ++k) CHECK(winding[k] == (k == region ? 1 : 0));
  }
}

TEST_CASE("regions of normals are covered once, whatever the circles are") {
  RandomBodies random(601);
  for (int k = 0; k < 300; ++k) {
    const Vector3d a = random.direction();
    const double angle = k % 3 == 0 ? random.logUniform(1e-3, 1.5) : random.uniform(0.05, M_PI_2);
    const Vector3d b = Eigen::AngleAxisd(angle, a.unitOrthogonal()) * a;
    const auto lift = [&](int which) {
      return which == 0   ? 0.0
             : which == 1 ? random.uniform(-0.99, 0.99)
                          : random.uniform(0.9, 0.99);
    };
    checkCovered({circleOf(a, lift(k % 2)), circleOf(b, lift(k % 4 < 2 ? 1 : k % 3))}, random);
  }
}

TEST_CASE("circles through the poles of a perpendicular axis are covered once") {
  RandomBodies random(602);
  for (int k = 0; k < 60; ++k) {
    const Vector3d a = random.direction(), b = a.unitOrthogonal();
    const double lift = random.uniform(-0.95, 0.95);
    checkCovered({circleOf(a, k % 3 == 0 ? 0.0 : lift), circleOf(b, 0.0)}, random);
    checkCovered({circleOf(a, 0.0), circleOf(b, k % 3 == 0 ? 0.0 : lift)}, random);
  }
}

TEST_CASE("circles that touch are left to a perturbation") {
  const Vector3d a = Vector3d::UnitZ();
  const double angle = 0.4;
  const Vector3d b(std::sin(angle), 0.0, std::cos(angle));
  CHECK_FALSE(normalOverlay({circleOf(a, std::cos(1.0)), circleOf(b, std::cos(1.0 - angle))}));
  CHECK(normalOverlay({circleOf(a, std::cos(1.0)), circleOf(b, std::cos(1.1 - angle))}));
}

}  // namespace
