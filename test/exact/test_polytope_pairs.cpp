// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Pairs of polytopes whose rounding is counted, against 50 digits.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>

#include <random>

#include "catch.h"
#include "fcl_prob/convex_parts.h"
#include "fcl_prob/convex_pcd.h"
#include "high_precision.h"

namespace {

using namespace fcl_prob;
using Eigen::Vector3d;
using fcl_prob_test::HighPrecision;
using Pose = fcl::Transform3d;

/// Two boxes along the axes of the displacement, in a world that may be turned by a matrix that is
/// exact: a permutation with signs.
struct AlignedBoxes {
  Vector3d half_a, half_b, at_a, at_b, sigma;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();

  HighPrecision truth() const {
    HighPrecision mass = 1;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const HighPrecision centre = HighPrecision(at_b[k]) - at_a[k];
      const HighPrecision reach = HighPrecision(half_a[k]) + half_b[k];
      mass *=
          fcl_prob_test::trueIntervalMass((centre - reach) / sigma[k], (centre + reach) / sigma[k]);
    }
    return mass;
  }

  Pose poseAt(const Vector3d& position) const {
    Pose pose(turn);
    pose.translation() = turn * position;
    return pose;
  }

  GaussianDisplacement displacement() const {
    return GaussianDisplacement::fromStandardDeviations(sigma, Eigen::Quaterniond(turn));
  }
};

/// The corners of a box and some points within it and on its faces.
ConvexBody boxOfPoints(const Vector3d& half, std::mt19937_64& generator) {
  std::uniform_real_distribution<double> part(-1, 1);
  std::vector<Vector3d> points;
  for (int corner = 0; corner < 8; ++corner) {
    points.emplace_back((corner & 1 ? 1 : -1) * half.x(), (corner & 2 ? 1 : -1) * half.y(),
                        (corner & 4 ? 1 : -1) * half.z());
  }
  for (int k = 0; k < 6; ++k) {
    Vector3d point = half.cwiseProduct(Vector3d(part(generator), part(generator), part(generator)));
    if (k < 3) point[k] = half[k];
    points.push_back(point);
  }
  return ConvexBody(*convexGeometry(convexHull(points)));
}

class BoxDraw {
 public:
  explicit BoxDraw(unsigned seed) : generator(seed) {}

  Vector3d three(double lo, double hi) {
    const double x = uniform(lo, hi), y = uniform(lo, hi), z = uniform(lo, hi);
    return {x, y, z};
  }
  double uniform(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(generator);
  }

  /// Of a size in deviations, and out to P = 1e-300 along one axis.
  AlignedBoxes boxes(double size, double far) {
    AlignedBoxes scene;
    scene.half_a = size * three(0.2, 1);
    scene.half_b = size * three(0.2, 1);
    scene.sigma = three(0.5, 1);
    scene.at_a = (size * three(-1, 1)).array() + far;
    const auto tail = static_cast<Eigen::Index>(uniform(0, 3));
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double reach = scene.half_a[k] + scene.half_b[k];
      const double centre =
          k == tail ? reach + uniform(-0.5, 36) * scene.sigma[k] : reach * uniform(-1, 1);
      scene.at_b[k] = scene.at_a[k] + centre;
    }
    if (uniform(0, 1) < 0.5) scene.turn << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    return scene;
  }

  std::mt19937_64 generator;
};

Bounds massOf(const AlignedBoxes& scene, const ConvexBody& a, const ConvexBody& b) {
  return convexPairMass(a, scene.poseAt(scene.at_a), b, scene.poseAt(scene.at_b),
                        scene.displacement());
}

void checkHolds(const AlignedBoxes& scene, const ConvexBody& a, const ConvexBody& b,
                double most_width) {
  const HighPrecision truth = scene.truth();
  if (truth < 1e-298) return;
  const Bounds found = massOf(scene, a, b);
  CAPTURE(found.lower, found.upper, truth.convert_to<double>());
  CAPTURE(found.width() / found.upper);
  REQUIRE(HighPrecision(found.lower) <= truth);
  REQUIRE(HighPrecision(found.upper) >= truth);
  CHECK(found.width() <= most_width * found.upper);
}

ConvexBody boxBody(const Vector3d& half) { return ConvexBody(fcl::Boxd(Vector3d(2 * half))); }

}  // namespace

constexpr double kWidest = 4e-8;

TEST_CASE("polytopes are certified to 4e-8 from 1e-3 to 1e3 deviations") {
  BoxDraw draw(5);
  for (const double size : {1e-3, 1e-2, 0.1, 0.3, 1.0, 10.0, 100.0, 1e3}) {
    for (int i = 0; i < 60; ++i) {
      CAPTURE(size, i);
      const AlignedBoxes scene = draw.boxes(size, 0.0);
      checkHolds(scene, boxBody(scene.half_a), boxBody(scene.half_b), kWidest);
      const ConvexBody points = boxOfPoints(scene.half_a, draw.generator);
      if (i < 15) checkHolds(scene, points, boxBody(scene.half_b), kWidest);
    }
  }
}

TEST_CASE("polytopes far from the origin lose nothing") {
  BoxDraw draw(6);
  for (const double size : {1e-3, 1.0, 1e3}) {
    for (int i = 0; i < 40; ++i) {
      CAPTURE(size, i);
      const AlignedBoxes scene = draw.boxes(size, 1e6 * size);
      checkHolds(scene, boxBody(scene.half_a), boxBody(scene.half_b), kWidest);
    }
  }
}

TEST_CASE("bodies of any proportions and scales hold the truth") {
  BoxDraw draw(7);
  int tight = 0;
  for (int i = 0; i < 400; ++i) {
    AlignedBoxes scene = draw.boxes(1.0, 0.0);
    for (Eigen::Index k = 0; k < 3; ++k) {
      // Needles, plates and bodies of up to 1e9 deviations, at their faces or away from them.
      const double stretch = std::pow(10.0, draw.uniform(-9, 9));
      scene.half_a[k] *= stretch;
      scene.half_b[k] *= stretch * std::pow(10.0, draw.uniform(-3, 0));
      const double reach = scene.half_a[k] + scene.half_b[k];
      scene.at_a[k] *= stretch;
      scene.at_b[k] = scene.at_a[k] + reach * draw.uniform(-1, 1) + draw.uniform(-9, 9);
    }
    const HighPrecision truth = scene.truth();
    const ConvexBody a = boxBody(scene.half_a), b = boxBody(scene.half_b);
    const Bounds mass = massOf(scene, a, b);
    CAPTURE(i, mass.lower, mass.upper, truth.convert_to<double>());
    CHECK(HighPrecision(mass.lower) <= truth);
    CHECK(HighPrecision(mass.upper) >= truth);
    tight += mass.width() <= 1e-6 * mass.upper;
  }
  CHECK(tight > 90);
}
